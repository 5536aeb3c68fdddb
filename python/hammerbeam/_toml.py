"""The text of a study from a dictionary: its keys are those of the study file."""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ._check import refused
from ._errors import BadInput


def study_text(tables: Mapping[str, Any]) -> str:
    """TOML of nested dictionaries; tables within tables stand in one line."""
    if not isinstance(tables, Mapping):
        raise refused("tables", tables, "must be a dictionary with the tables of a study")
    try:
        return _document(tables)
    except RecursionError:
        raise BadInput("tables: they are nested too deeply, or hold themselves") from None


def _document(tables: Mapping[str, Any]) -> str:
    plain, below = list[str](), list[str]()
    for key, value in tables.items():
        if value is None:
            continue
        if isinstance(value, Mapping):
            below.append(_table(f"[{_key(key)}]", value, key))
        elif _is_list_of_tables(value):
            below.extend(_table(f"[[{_key(key)}]]", entry, key) for entry in value)
        else:
            plain.append(f"{_key(key)} = {_value(value, key)}\n")
    return "".join(plain) + "".join("\n" + table for table in below)


def _table(head: str, table: Mapping[str, Any], name: str) -> str:
    """A table with its lists of tables below it."""
    lines, below = [head + "\n"], list[str]()
    for key, value in table.items():
        path = f"{name}.{key}"
        if value is None:
            continue
        if head.startswith("[") and not head.startswith("[[") and _is_list_of_tables(value):
            inner = f"[[{head[1:-1]}.{_key(key)}]]"
            below.extend("\n" + _table(inner, entry, path) for entry in value)
        else:
            lines.append(f"{_key(key)} = {_value(value, path)}\n")
    return "".join(lines + below)


def _is_list_of_tables(value: Any) -> bool:
    is_list = isinstance(value, Sequence) and not isinstance(value, (str, bytes))
    return is_list and len(value) > 0 and all(isinstance(entry, Mapping) for entry in value)


def _key(key: Any) -> str:
    if not isinstance(key, str):
        raise refused("key", key, "must be a word")
    is_bare = bool(key) and all(letter.isascii() and (letter.isalnum() or letter in "-_") for letter in key)
    return key if is_bare else _text(key)


def _value(value: Any, name: str) -> str:
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return repr(value) if math.isfinite(value) else str(value)
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, Mapping):
        entries = (
            f"{_key(key)} = {_value(entry, f'{name}.{key}')}"
            for key, entry in value.items()
            if entry is not None
        )
        return "{ " + ", ".join(entries) + " }"
    if isinstance(value, Sequence) and not isinstance(value, bytes):
        return "[" + ", ".join(_value(entry, name) for entry in value) + "]"
    raise refused(name, value, "must be a number, a word, true or false, a list or a dictionary")


def _text(text: str) -> str:
    try:
        text.encode()
    except UnicodeEncodeError:
        raise refused("text", text, "must be Unicode") from None
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
