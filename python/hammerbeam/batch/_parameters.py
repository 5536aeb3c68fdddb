"""Tables of parameters: one row for each study, one column for each key of the study file."""

import csv
import itertools
from collections.abc import Iterable, Mapping, Sequence
from io import StringIO
from os import PathLike
from typing import Any

import numpy as np

from .. import _check
from .._errors import BadInput

MOST_ROWS = 1_000_000


class Parameters:
    """Values of keys, row by row. Keys are those of `--set`, such as `stop.1.gap_m`.

    * `keys`: the keys of the columns.
    * `rows`: the values as they are written into the study, as texts.
    """

    def __init__(self, keys: Sequence[str], rows: Iterable[Sequence[Any]]) -> None:
        self.keys = tuple(_check.words("keys", keys))
        given = _check.entries("rows", rows, "must be a list of rows", MOST_ROWS)
        self.rows = [tuple(_text(key, value) for key, value in self._paired(row)) for row in given]
        if not self.rows:
            raise BadInput("the table of parameters has no row")
        if len(set(self.keys)) < len(self.keys):
            raise BadInput("two columns of the table of parameters have the same key")

    def _paired(self, row: Sequence[Any]) -> Iterable[tuple[str, Any]]:
        values = _check.entries("rows", row, "must have a list of values in each row")
        if len(values) != len(self.keys):
            message = f"a row of the table of parameters has {len(values)} values, "
            numbers = {"found": len(values), "expected": len(self.keys)}
            raise BadInput(message + f"its columns are {len(self.keys)}", numbers=numbers)
        return zip(self.keys, values, strict=True)

    @classmethod
    def grid(cls, values: Mapping[str, Iterable[Any]]) -> "Parameters":
        """All combinations of values, the last key changing fastest."""
        if not isinstance(values, Mapping):
            raise _check.refused("values", values, "must be a dictionary of lists by keys")
        must = "must be a list of values"
        columns = [_check.entries(str(key), column, must, MOST_ROWS) for key, column in values.items()]
        return cls(list(values), itertools.product(*columns))

    @classmethod
    def latin_hypercube(
        cls, ranges: Mapping[str, tuple[float, float]], count: int, seed: int
    ) -> "Parameters":
        """So many samples, of which each of `count` equal parts of every range has exactly one.

        McKay, Beckman and Conover, Technometrics 21 (1979), 239-245. The same seed gives the same table
        with the same version of NumPy; the batch folder keeps the values themselves.
        """
        rows = _check.whole("count", count, 1, MOST_ROWS)
        if not isinstance(ranges, Mapping):
            raise _check.refused("ranges", ranges, "must be a dictionary of (LOW, HIGH) by keys")
        random = np.random.default_rng(_check.whole("seed", seed, 0, 2**63 - 1))
        columns = []
        for key, ends in ranges.items():
            low, high = _check.rising(key, ends)
            part = (random.permutation(rows) + random.random(rows)) / rows
            columns.append((low + (high - low) * part).tolist())
        return cls(list(ranges), zip(*columns, strict=True))

    @classmethod
    def read(cls, path: str | PathLike[str]) -> "Parameters":
        """A file of comma-separated values with the keys in its first line."""
        place = _check.folder("path", path)
        try:
            text = place.read_text(encoding="utf-8-sig")
        except OSError as error:
            raise BadInput(f"{place}: {error.strerror}") from error
        except UnicodeError as error:
            raise BadInput(f"{place}: is no text in UTF-8") from error
        return cls.parse(text)

    @classmethod
    def parse(cls, text: str) -> "Parameters":
        """The same from a text."""
        if not isinstance(text, str):
            raise _check.refused("text", text, "must be a text of comma-separated values")
        lines = [row for row in csv.reader(StringIO(text), skipinitialspace=True) if row]
        if not lines:
            raise BadInput("the table of parameters is empty; its first line has the keys")
        return cls([key.strip() for key in lines[0]], ([value.strip() for value in row] for row in lines[1:]))

    def __len__(self) -> int:
        return len(self.rows)

    def settings(self, row: int) -> dict[str, str]:
        """Values of a row, counted from 0, by keys."""
        place = _check.whole("row", row, 0, len(self) - 1)
        return dict(zip(self.keys, self.rows[place], strict=True))

    def column(self, key: str) -> "np.ndarray[Any, np.dtype[Any]]":
        """The values of a key: numbers if all are, else texts."""
        if not isinstance(key, str) or key not in self.keys:
            raise _check.unknown("column", key, self.keys)
        texts = [row[self.keys.index(key)] for row in self.rows]
        try:
            return np.array([float(text) for text in texts])
        except ValueError:
            return np.array(texts, dtype=str)

    def __repr__(self) -> str:
        return f"<Parameters: {len(self)} rows of {', '.join(self.keys) or 'nothing'}>"


def _text(key: str, value: Any) -> str:
    """A value as it stands in the study file."""
    _, _, text = _check.setting(key, value).partition("=")
    if not key or not text:
        raise BadInput(f"{key or 'a column without a key'}: found no value in the table of parameters")
    return text
