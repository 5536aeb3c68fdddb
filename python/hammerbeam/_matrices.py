"""Structures from arrays: the files of a study of kind "matrices"."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from . import _native
from ._check import whole
from ._errors import BadInput
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
    entries = {name: _entries(name, matrix) for name, matrix in matrices.items() if matrix is not None}
    size = entries["K"][0]
    named = {str(name): whole(f"points[{name!r}]", row, 0, max(size - 1, 0)) for name, row in _items(points)}
    held = [whole("fixed", row, 0, max(size - 1, 0)) for row in fixed]
    keys = {"K": "stiffness", "M": "mass", "C": "damping"}
    structure: dict[str, Any] = {"kind": "matrices"}
    structure |= {keys[name]: f"{name}.mtx" for name in entries}
    structure["point"] = [{"name": name, "row": row + 1} for name, row in named.items()] or None
    if held:
        structure["fixed"] = [{"rows": [row + 1 for row in held]}]
    extra = tables.get("structure")
    if extra is not None:
        structure |= dict(_items(extra))
    text = study_text({**tables, "structure": structure})
    folder.mkdir(parents=True, exist_ok=True)
    for name, (rows, lines, columns, values) in entries.items():
        shape = (rows, rows)
        _native.write_matrix(
            folder / f"{name}.mtx", shape, lines.tobytes(), columns.tobytes(), values.tobytes()
        )
    path = folder / "study.toml"
    path.write_text(text, encoding="utf-8")
    return path


def _items(mapping: Any) -> Any:
    if not isinstance(mapping, Mapping):
        raise BadInput(f"found {mapping!r}, must be a dictionary")
    return mapping.items()


Entries = tuple[int, np.ndarray[Any, Any], np.ndarray[Any, Any], np.ndarray[Any, Any]]
"""Number of rows; row, column and value of each entry."""


def _entries(name: str, matrix: Any) -> Entries:
    if hasattr(matrix, "tocoo"):
        sparse = matrix.tocoo()
        sparse.sum_duplicates()
        shape, rows, columns, values = sparse.shape, sparse.row, sparse.col, sparse.data
    else:
        try:
            dense = np.asarray(matrix)
        except (TypeError, ValueError) as error:
            raise BadInput(f"{name}: {error}") from error
        if dense.ndim != 2:
            raise BadInput(f"{name}: found an array of shape {dense.shape}, must be a square matrix")
        shape = dense.shape
        rows, columns = np.nonzero(dense)
        values = dense[rows, columns]
    if len(shape) != 2 or shape[0] != shape[1] or shape[0] == 0:
        raise BadInput(f"{name}: found an array of shape {tuple(shape)}, must be a square matrix")
    if np.asarray(values).dtype.kind not in "iuf":
        raise BadInput(f"{name}: found an array of {np.asarray(values).dtype}, must be real numbers")
    return (
        int(shape[0]),
        np.ascontiguousarray(rows, dtype="<i8"),
        np.ascontiguousarray(columns, dtype="<i8"),
        np.ascontiguousarray(values, dtype="<f8"),
    )
