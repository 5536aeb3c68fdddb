"""Tables: packed records as structured arrays, and as data frames."""

from typing import Any

import numpy as np

from ._check import refused
from ._errors import BadInput

Array = np.ndarray[Any, np.dtype[Any]]
"""An array; where rows of a table are meant, a structured one."""

Packed = tuple[str, list[tuple[str, str, int | None]], int, Array]
"""Name, fields, number of rows, and the rows as an array of bytes."""


def array(packed: Packed) -> Array:
    """Records as a structured array on the same memory."""
    _, fields, rows, data = packed
    kind = np.dtype(
        [
            (name, letters) if length is None else (name, letters, (length,))
            for name, letters, length in fields
        ]
    )
    if rows == 0:
        return np.empty(0, dtype=kind)
    return data.view(kind)


def frame(table: Array) -> Any:
    """A structured array as a data frame of pandas.

    Columns with several numbers in a row, states and multipliers, become one column for each of them,
    `state_1` and so on.
    """
    if not isinstance(table, np.ndarray) or table.dtype.names is None:
        raise refused("table", table, "must be a structured array")
    pandas = needed("pandas", "frames")
    columns: dict[str, Any] = {}
    for name in table.dtype.names or ():
        values = table[name]
        if values.ndim == 1:
            columns[name] = values
        else:
            columns.update({f"{name}_{k + 1}": values[:, k] for k in range(values.shape[1])})
    return pandas.DataFrame(columns)


def needed(module: str, extra: str) -> Any:
    """An optional package, or the words that say how to get it."""
    import importlib

    try:
        return importlib.import_module(module)
    except ImportError as error:
        package = module.partition(".")[0]
        message = f"this needs the package {package}: pip install 'hammerbeam[{extra}]'"
        raise BadInput(message) from error
