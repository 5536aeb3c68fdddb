"""Formats that are written from Python: MAT, Parquet, HDF5."""

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ._check import unknown
from ._errors import ExportError
from ._files import whole_files
from ._tables import Array, needed

NATIVE = ("csv", "json", "npz")


def checked(format: Any) -> str:
    """A format that can be written."""
    known = (*NATIVE, *WRITERS)
    if not isinstance(format, str) or format not in known:
        raise unknown("format", format, known)
    return format


def write(tables: Mapping[str, Array], format: str, folder: Path, name: str) -> list[Path]:
    """Writes tables in a format; one file each in those that hold one table. Each file is there whole, or as
    it was before."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with whole_files(folder) as place:
            written = WRITERS[format](tables, place, name)
        return [folder / path.name for path in written]
    except OSError as error:
        raise ExportError(f"{folder}: {error.strerror or error}") from error


def _mat(tables: Mapping[str, Array], folder: Path, name: str) -> list[Path]:
    """A struct for each table, a column vector or a matrix for each column; words as cells. The struct
    `columns` has the columns of each table by their own names, in the order of its fields."""
    scipy_io = needed("scipy.io", "mat")
    path = folder / f"{name}.mat"
    columns = {table: list(rows.dtype.names or ()) for table, rows in tables.items()}
    fields = dict(zip(tables, _fields(tables), strict=True))
    structs: dict[str, Any] = {
        fields[table]: dict(zip(_fields(columns[table]), map(_plain, _values(rows)), strict=True))
        for table, rows in tables.items()
    }
    structs["columns"] = {fields[table]: _plain(np.array(columns[table])) for table in tables}
    scipy_io.savemat(path, structs, oned_as="column", long_field_names=True)
    return [path]


def _values(rows: Array) -> list[Array]:
    return [rows[column] for column in rows.dtype.names or ()]


def _plain(values: Array) -> Array:
    """Words as objects, which become cells."""
    return values.astype(object) if values.dtype.kind == "U" else values


LONGEST_FIELD = 63


def _fields(names: Iterable[str]) -> list[str]:
    """Names of fields of a struct: a letter, then letters, digits and underscores, 63 in all, each once. A name
    that would come again has a number behind it."""
    fields = list[str]()
    for name in names:
        word = "".join(letter if letter.isascii() and letter.isalnum() else "_" for letter in name)
        word = (word if word[:1].isalpha() else f"x{word}")[:LONGEST_FIELD]
        field, number = word, 1
        while field in fields:
            number += 1
            end = f"_{number}"
            field = word[: LONGEST_FIELD - len(end)] + end
        fields.append(field)
    return fields


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
