"""Structures from arrays: the files of a study of kind "matrices"."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from . import _native
from ._check import refused, shaped, whole
from ._errors import BadInput, StudyError
from ._toml import study_text


def write_bundle(
    folder: Path,
    matrices: Mapping[str, Any],
    points: Mapping[str, int],
    fixed: Sequence[int],
    tables: Mapping[str, Any],
) -> Path:
    """Writes matrices and the study that reads them into a folder.

    * `matrices`: `M`, `K`, and `C` or `None`: square arrays or sparse matrices of SciPy, in SI units.
    * `points`, `fixed`: rows, from 0 on.
    * `tables`: further tables of the study; keys in `structure` are added to those that are written here.

    Returns the study file.
    """
    for name in ("M", "K"):
        if matrices[name] is None:
            raise refused(name, None, "must be a square matrix")
    entries = {name: _entries(name, matrix) for name, matrix in matrices.items() if matrix is not None}
    for name, given in entries.items():
        _refuse_unsymmetric(name, *given)
    size = entries["K"][0]
    rows_named = _items("points", points)
    named = {str(name): whole(f"points[{name!r}]", row, 0, max(size - 1, 0)) for name, row in rows_named}
    if isinstance(fixed, (str, bytes)) or not isinstance(fixed, Iterable):
        raise refused("fixed", fixed, "must be a list of rows")
    held = [whole("fixed", row, 0, max(size - 1, 0)) for row in fixed]
    keys = {"K": "stiffness", "M": "mass", "C": "damping"}
    structure: dict[str, Any] = {"kind": "matrices"}
    structure |= {keys[name]: f"{name}.mtx" for name in entries}
    structure["point"] = [{"name": name, "row": row + 1} for name, row in named.items()] or None
    if held:
        structure["fixed"] = [{"rows": [row + 1 for row in held]}]
    extra = tables.get("structure")
    if extra is not None:
        structure |= dict(_items("structure", extra))
    text = study_text({**tables, "structure": structure})
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadInput(f"folder: {folder}: {error.strerror or error}") from error
    for name, (rows, lines, columns, values) in entries.items():
        shape = (rows, rows)
        _native.write_matrix(
            folder / f"{name}.mtx", shape, lines.tobytes(), columns.tobytes(), values.tobytes()
        )
    path = folder / "study.toml"
    path.write_text(text, encoding="utf-8")
    return path


def _items(name: str, mapping: Any) -> Any:
    if not isinstance(mapping, Mapping):
        raise refused(name, mapping, "must be a dictionary")
    return mapping.items()


Entries = tuple[int, np.ndarray[Any, Any], np.ndarray[Any, Any], np.ndarray[Any, Any]]
"""Number of rows; row, column and value of each entry."""


def _entries(name: str, matrix: Any) -> Entries:
    if hasattr(matrix, "tocoo"):
        # A copy: entries of one place are summed, and the matrix stays as it was given.
        sparse = matrix.tocoo(copy=True)
        sparse.sum_duplicates()
        array, rows, columns, values = sparse, sparse.row, sparse.col, sparse.data
    else:
        try:
            dense = np.asarray(matrix)
        except (TypeError, ValueError) as error:
            raise BadInput(f"{name}: {error}") from error
        if np.ma.is_masked(matrix):
            raise BadInput(f"{name}: entries are masked; allowed: numbers everywhere")
        if dense.ndim != 2:
            raise shaped(name, dense, "must be a square matrix")
        array = dense
        rows, columns = np.nonzero(dense)
        values = dense[rows, columns]
    shape = array.shape
    if len(shape) != 2 or shape[0] != shape[1] or shape[0] == 0:
        raise shaped(name, array, "must be a square matrix")
    if np.asarray(values).dtype.kind not in "iuf":
        raise BadInput(f"{name}: found an array of {np.asarray(values).dtype}, must be real numbers")
    return (
        int(shape[0]),
        np.ascontiguousarray(rows, dtype="<i8"),
        np.ascontiguousarray(columns, dtype="<i8"),
        np.ascontiguousarray(values, dtype="<f8"),
    )


_SYMMETRIC = 1e-6
"""Mirrored entries may differ by this part of `sqrt(a_ii a_jj)` and of themselves, as in files of
matrices."""


def _refuse_unsymmetric(
    name: str,
    size: int,
    rows: np.ndarray[Any, Any],
    columns: np.ndarray[Any, Any],
    values: np.ndarray[Any, Any],
) -> None:
    """Refuses what the reader of files would take for one triangle of a symmetric matrix: an array has both.

    An entry whose mirrored one is missing stands against 0.
    """
    diagonal = np.zeros(size)
    diagonal[rows[rows == columns]] = np.sqrt(np.abs(values[rows == columns]))
    places, mirrors = rows * size + columns, columns * size + rows
    order = np.argsort(places, kind="stable")
    at = np.minimum(np.searchsorted(places[order], mirrors), max(len(places) - 1, 0))
    found = places[order][at] == mirrors
    mirrored = np.where(found, values[order][at], 0.0)
    with np.errstate(invalid="ignore", over="ignore"):
        sizes = np.maximum(np.abs(values), np.abs(mirrored))
        allowed = _SYMMETRIC * np.maximum(diagonal[rows] * diagonal[columns], sizes)
        faults = np.flatnonzero(np.abs(values - mirrored) > allowed)
    if len(faults):
        first = int(faults[0])
        numbers = {
            "row": int(rows[first]) + 1,
            "column": int(columns[first]) + 1,
            "value": float(values[first]),
            "mirrored": float(mirrored[first]),
        }
        place = f"row {numbers['row']}, column {numbers['column']}"
        raise StudyError(
            f"{name}: matrix {name} is not symmetric: {place} is {numbers['value']!r}, "
            f"and mirrored {numbers['mirrored']!r}",
            name="NotSymmetric",
            numbers=numbers,
        )
