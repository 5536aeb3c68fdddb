"""Formats that are written from Python: MAT, Parquet, HDF5."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ._check import unknown
from ._errors import ExportError
from ._tables import Array, needed

NATIVE = ("csv", "json", "npz")


def checked(format: Any) -> str:
    """A format that can be written."""
    known = (*NATIVE, *WRITERS)
    if not isinstance(format, str) or format not in known:
        raise unknown("format", format, known)
    return format


def write(tables: Mapping[str, Array], format: str, folder: Path, name: str) -> list[Path]:
    """Writes tables in a format; one file each in those that hold one table."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        return WRITERS[format](tables, folder, name)
    except OSError as error:
        raise ExportError(f"{folder}: {error.strerror or error}") from error


def _mat(tables: Mapping[str, Array], folder: Path, name: str) -> list[Path]:
    """A struct for each table, a column vector or a matrix for each column; words as cells."""
    scipy_io = needed("scipy.io", "mat")
    path = folder / f"{name}.mat"
    structs = {table.replace("-", "_"): _columns(rows) for table, rows in tables.items()}
    scipy_io.savemat(path, structs, oned_as="column", long_field_names=True)
    return [path]


def _columns(rows: Array) -> dict[str, Any]:
    # A field of a struct is a letter, then letters, digits and underscores.
    def plain(name: str) -> str:
        word = "".join(letter if letter.isascii() and letter.isalnum() else "_" for letter in name)
        return word if word[:1].isalpha() else f"x{word}"

    def words(values: Array) -> Array:
        return values.astype(object) if values.dtype.kind == "U" else values

    return {plain(name): words(rows[name]) for name in rows.dtype.names or ()}


def _parquet(tables: Mapping[str, Array], folder: Path, name: str) -> list[Path]:
    """A file for each table."""
    arrow, parquet = needed("pyarrow", "parquet"), needed("pyarrow.parquet", "parquet")
    paths = []
    for table, rows in tables.items():
        columns = {}
        for column in rows.dtype.names or ():
            values = rows[column]
            if values.dtype.kind == "c":
                columns[f"{column}_re"], columns[f"{column}_im"] = (
                    _lists(arrow, values.real),
                    _lists(arrow, values.imag),
                )
            else:
                columns[column] = _lists(arrow, values)
        path = folder / f"{table}.parquet"
        parquet.write_table(arrow.table(columns), path)
        paths.append(path)
    return paths


def _lists(arrow: Any, values: Array) -> Any:
    values = np.ascontiguousarray(values)
    if values.ndim == 1:
        return arrow.array(values.tolist() if values.dtype.kind == "U" else values)
    return arrow.FixedSizeListArray.from_arrays(arrow.array(values.ravel()), values.shape[1])


def _hdf5(tables: Mapping[str, Array], folder: Path, name: str) -> list[Path]:
    """A group for each table, a data set for each column."""
    h5py = needed("h5py", "hdf5")
    path = folder / f"{name}.h5"
    with h5py.File(path, "w") as file:
        for table, rows in tables.items():
            group = file.create_group(table)
            for column in rows.dtype.names or ():
                values = rows[column]
                kind = h5py.string_dtype() if values.dtype.kind == "U" else None
                group.create_dataset(column, data=values.astype(object) if kind else values, dtype=kind)
    return [path]


WRITERS: dict[str, Callable[[Mapping[str, Array], Path, str], list[Path]]] = {
    "mat": _mat,
    "parquet": _parquet,
    "hdf5": _hdf5,
}
