"""Parts of basins and sweeps: they merge to the bytes of one process."""

from pathlib import Path
from typing import Any

import hammerbeam
import pytest
from hammerbeam.batch import Batch, Local, Parameters, Task


def tables(folder: Path) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.glob("*.csv"))}


def test_basins_by_parts_are_those_of_one_process(tmp_path: Path, duffing: hammerbeam.Study) -> None:
    asked = (0.25, ("q1", -2.0, 2.0), ("v1", -3.0, 3.0))
    options: dict[str, Any] = {"grid": 40, "transient_periods": 5, "patience_periods": 100}
    whole = duffing.basins(*asked, **options, out=tmp_path / "whole", progress=False)
    task = Task.basins(*asked, **options, parts=3)
    planned = Batch.plan(tmp_path / "b", duffing, Parameters.grid({"excitation.amplitude_n": [0.3]}), task)
    assert len(planned) == 3 and planned.run(Local(2)).finished == 3
    gathered = planned.gather()
    assert gathered.table["attractors"][0] == len(whole.attractors)
    assert tables(planned.whole(1).results) == tables(tmp_path / "whole") != {}
    # Without one of the parts the rest is computed, to the same bytes again.
    folders = [planned.item(number).results for number in (1, 3)]
    duffing.basins(*asked, **options, parts=folders, out=tmp_path / "again", progress=False)
    assert tables(tmp_path / "again") == tables(tmp_path / "whole")
    # A part of something else is refused.
    with pytest.raises(hammerbeam.StoreError, match="holds no part of this"):
        duffing.basins(*asked, **{**options, "grid": 41}, parts=folders, progress=False)


def test_an_attractor_that_only_a_late_cell_finds_changes_nothing(
    tmp_path: Path, duffing: hammerbeam.Study
) -> None:
    # The first 256 of 576 cells start near rest, which leads to the small motion: of the large one no part
    # knows before.
    asked = (0.25, ("q1", -0.2, 0.2), ("v1", -0.3, 3.0))
    options: dict[str, Any] = {"grid": 24, "transient_periods": 5, "patience_periods": 100}
    duffing.basins(*asked, **options, out=tmp_path / "whole", progress=False)
    parts = [tmp_path / str(number) for number in (1, 2)]
    for number, part in enumerate(parts, 1):
        named: dict[str, Any] = {"frequency_hz": asked[0], "x": asked[1], "y": asked[2]}
        duffing.basins_part((number, 2), part, **named, **options, progress=False)
    with pytest.warns(hammerbeam.HammerbeamWarning, match="computed again"):
        duffing.basins(*asked, **options, parts=parts, out=tmp_path / "merged", progress=False)
    assert tables(tmp_path / "merged") == tables(tmp_path / "whole") != {}


def test_a_sweep_by_parts_is_that_of_one_process(tmp_path: Path, duffing: hammerbeam.Study) -> None:
    options: dict[str, Any] = {
        "from_hz": 0.2,
        "to_hz": 0.3,
        "step_hz": 0.02,
        "starts": 3,
        "patience_periods": 60,
    }
    duffing.sweep(**options, out=tmp_path / "whole", progress=False)
    planned = Batch.plan(
        tmp_path / "b",
        duffing,
        Parameters.grid({"excitation.amplitude_n": [0.3]}),
        Task.sweep(**options, parts=4),
    )
    assert planned.run(Local(2)).finished == 4
    planned.merge()
    assert tables(planned.whole(1).results) == tables(tmp_path / "whole") != {}
    with pytest.raises(hammerbeam.BadInput, match="has no parts"):
        folder = planned.item(1).results
        duffing.sweep(0.2, 0.3, 0.02, parts=[folder], progress=False)
