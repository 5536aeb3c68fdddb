"""One table and one figure of all items."""

import csv
from io import StringIO
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .._files import write_whole
from .. import _check
from .._errors import BadInput, WriteError
from .._look import axes, framed
from .._results import Results
from .._tables import Array, frame
from ._folder import Status, read_json

if TYPE_CHECKING:
    from ._batch import Batch


class Gathered:
    """What came of a batch, one row for each row of its parameters.

    * `table`: a structured array: `row`, `status`, the parameters by their keys, the numbers of the
      results. Where there is no number it is NaN.
    * `quantities`: the names of these numbers.
    """

    def __init__(self, batch: "Batch") -> None:
        self.batch = batch
        rows = range(1, len(batch.parameters) + 1)
        folders = [batch.whole(row) for row in rows]
        statuses = [folder.status() for folder in folders]
        found = [
            read_json(folder.report)["numbers"] if status is Status.FINISHED else {}
            for folder, status in zip(folders, statuses, strict=True)
        ]
        self.quantities = list(dict.fromkeys(name for numbers in found for name in numbers))
        columns: dict[str, Array] = {
            "row": np.array(rows, dtype=np.int64),
            "status": np.array([status.value for status in statuses]),
        }
        columns |= {key: batch.parameters.column(key) for key in batch.parameters.keys}
        for name in self.quantities:
            columns[name] = np.array([numbers.get(name, np.nan) for numbers in found], dtype=float)
        self.table = np.empty(len(rows), dtype=[(name, column.dtype) for name, column in columns.items()])
        for name, column in columns.items():
            self.table[name] = column

    def frame(self) -> Any:
        """The table as a data frame of pandas."""
        return frame(self.table)

    def branches(self) -> Array:
        """All branches of all studies, with the number of the row of the parameters in front."""
        tables = []
        for row, folder in self.batch.results():
            with Results(folder) as results:
                tables.append((row, results.branches()))
        if not tables:
            raise BadInput("no item is finished: there are no branches")
        kind = np.result_type(*(table.dtype for _, table in tables))
        joined = np.empty(sum(len(table) for _, table in tables), dtype=[("row", "<i8"), *kind.descr])
        joined["row"] = np.concatenate([np.full(len(table), row) for row, table in tables])
        for name in kind.names or ():
            joined[name] = np.concatenate([table[name] for _, table in tables])
        return joined

    def text(self) -> str:
        """The table as comma-separated values; a number that is not there is left out."""
        out = StringIO()
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(self.table.dtype.names or ())
        for row in self.table.tolist():
            writer.writerow("" if entry != entry else entry for entry in row)
        return out.getvalue()

    def write(self, folder: str | PathLike[str] | None = None) -> list[Path]:
        """Writes `gathered.csv`, and `gathered.svg` with matplotlib, into the batch folder by default."""
        place = self.batch.folder if folder is None else _check.folder("folder", folder)
        try:
            place.mkdir(parents=True, exist_ok=True)
            write_whole(place / "gathered.csv", self.text())
        except OSError as error:
            raise WriteError(f"{place}: {error.strerror or error}") from error
        files = [place / "gathered.csv"]
        try:
            drawn = self.plot()
        except BadInput:
            return files
        drawn.figure.savefig(place / "gathered.svg")
        return [*files, place / "gathered.svg"]

    def plot(self, quantity: str | None = None, ax: Any = None) -> Any:
        """Draws a quantity over the parameter with matplotlib; over two parameters as colours.

        * `quantity`: by default the largest displacement, or else the first one.
        """
        usual = "max_abs_displacement_m"
        chosen = (
            (usual if usual in self.quantities else next(iter(self.quantities), ""))
            if quantity is None
            else quantity
        )
        if not isinstance(chosen, str) or chosen not in self.quantities:
            raise _check.unknown("quantity", chosen, self.quantities)
        drawn, values = axes(ax), self.table[chosen]
        varied = [key for key in self.batch.parameters.keys if len(set(self.table[key].tolist())) > 1]
        keys = (varied or list(self.batch.parameters.keys) or ["row"])[:2]
        framed(drawn, keys[0], chosen if len(keys) == 1 else keys[1])
        if len(keys) == 1:
            order = np.argsort(self.table[keys[0]], kind="stable")
            drawn.plot(self.table[keys[0]][order], values[order], "o-", markersize=3)
        else:
            points = drawn.scatter(self.table[keys[0]], self.table[keys[1]], c=values, s=16)
            drawn.figure.colorbar(points, ax=drawn, label=chosen)
        return drawn

    def __repr__(self) -> str:
        return f"<Gathered: {len(self.table)} rows, {len(self.quantities)} quantities>"
