"""Results folders: tables, orbits, figures, files for other programs."""

import csv
import json
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import hammerbeam
import numpy as np
import pytest
from hammerbeam import Results, _export


def rows_of(path: Path) -> list[dict[str, str]]:
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def test_branches_are_those_of_the_csv(results: Results, tmp_path: Path) -> None:
    files = results.export("csv", tmp_path, states=True)
    assert {path.name for path in files} >= {"branches.csv", "events.csv", "ends.csv", "states.csv"}
    rows, table = rows_of(tmp_path / "branches.csv"), results.branches()
    assert len(rows) == len(table) > 100
    words = {"stable", "event"}
    assert [name for name in table.dtype.names or () if name != "stability"] == list(rows[0])
    for name in set(rows[0]) - words:
        # The numbers of the file read back to the same doubles, so these are the same bytes.
        assert table[name].tobytes() == np.array([row[name] for row in rows], table[name].dtype).tobytes()
    assert list(table["event"]) == [row["event"] for row in rows]
    assert list(table["stable"]) == [row["stable"] == "true" for row in rows]
    known = {"true": "stable", "marginal": "marginal", "false": "unstable"}
    assert list(table["stability"]) == [known[row["stable"]] for row in rows]
    events, expected = results.events(), rows_of(tmp_path / "events.csv")
    assert list(events["event"]) == [row["event"] for row in expected]
    np.testing.assert_array_equal(events["frequency_hz"], [float(row["frequency_hz"]) for row in expected])
    states, expected = results.states(), rows_of(tmp_path / "states.csv")
    np.testing.assert_array_equal(
        states["state"], [[float(x) for x in row["state"].split()] for row in expected]
    )
    assert [row["message"] for row in rows_of(tmp_path / "ends.csv")] == list(results.ends()["message"])


def test_the_folds_are_where_the_multiplier_is_one(results: Results) -> None:
    folds = results.events()
    folds = folds[folds["event"] == "fold"]
    assert len(folds) == 2
    # x'' + 0.1 x' + x + x^3 = 0.3 cos(W t): three solutions coexist at 0.25 Hz, one at 0.2 Hz.
    assert 0.2 < folds["frequency_hz"].min() < 0.25 < folds["frequency_hz"].max()
    np.testing.assert_allclose(folds["multiplier_re"], 1.0, atol=1e-5)


def test_a_branch_by_its_number(results: Results) -> None:
    assert set(results.branches(1)["branch"]) == {1}
    assert len(results.branches([1])) == len(results.branches(1))
    assert len(results.branches(99)) == 0


def test_orbits_by_frequency_branch_and_event(results: Results) -> None:
    crossing = results.orbits(0.25)
    assert len(crossing) == 3 and {orbit.branch for orbit in crossing} == {1}
    folds = results.orbits(event="fold")
    assert len(folds) == 2 and all("fold" in orbit.event for orbit in folds)
    assert len(results.orbits(0.25, branch=99)) == 0
    for orbit in crossing:
        waveform = orbit.waveform(128)
        largest = abs(waveform["mass_displacement_m"]).max()
        assert largest <= orbit.max_abs_displacement_m * (1 + 1e-12)
        assert largest > 0.999 * orbit.max_abs_displacement_m
        # The product of all multipliers is that of the damping alone.
        np.testing.assert_allclose(np.prod(orbit.multipliers).real, np.exp(-0.1 / 0.25), rtol=1e-7)


def test_a_slice_of_orbits_is_orbits(results: Results, tmp_path: Path) -> None:
    orbits = results.orbits(0.25)
    last = orbits[-1:]
    assert isinstance(last, hammerbeam.Orbits) and len(last) == 1 and len(orbits[3:]) == 0
    np.testing.assert_array_equal(last[0].waveform(8), orbits[2].waveform(8))
    # Each table counts its orbits from 1 on.
    names = [name for name in orbits.table.dtype.names or () if name != "orbit"]
    back = orbits[::-1].table
    assert back["orbit"].tolist() == [1, 2, 3]
    assert all((back[name] == orbits.table[name][::-1]).all() for name in names)
    [path] = results.export_orbits(orbits[1:], "npz", tmp_path, samples=8)
    with np.load(path) as found:
        np.testing.assert_array_equal(found["orbits"]["state"], orbits.table["state"][1:])
        assert set(found["waveforms"]["orbit"]) == {1, 2}
    # None of them is no file without a table.
    [path] = results.export_orbits(orbits[:0], "npz", tmp_path / "none", samples=8)
    with np.load(path) as found:
        assert len(found["orbits"]) == 0


def test_frames_have_a_column_for_each_number(results: Results) -> None:
    pytest.importorskip("pandas")
    frame = results.frame()
    assert len(frame) == len(results.branches()) and frame["stable"].dtype == bool
    assert {"state_1", "state_2", "multipliers_1"} <= set(hammerbeam.frame(results.states()).columns)


def test_npz_and_json_hold_the_tables(results: Results, tmp_path: Path) -> None:
    [path] = results.export("npz", tmp_path, states=True)
    with np.load(path) as found:
        np.testing.assert_array_equal(found["branches"], results.branches())
        np.testing.assert_array_equal(found["states"]["multipliers"], results.states()["multipliers"])
        assert set(found.files) == {"branches", "events", "ends", "states"}
    [path] = results.export("json", tmp_path)
    document = json.loads(path.read_text())
    assert document["branches"]["frequency_hz"] == results.branches()["frequency_hz"].tolist()
    assert document["branches"]["event"] == results.branches()["event"].tolist()


def test_mat_holds_a_struct_for_each_table(results: Results, tmp_path: Path) -> None:
    scipy_io = pytest.importorskip("scipy.io")
    [path] = results.export("mat", tmp_path, states=True)
    found = scipy_io.loadmat(path, squeeze_me=True, struct_as_record=False)
    np.testing.assert_array_equal(found["branches"].frequency_hz, results.branches()["frequency_hz"])
    np.testing.assert_array_equal(found["states"].multipliers, results.states()["multipliers"])
    assert list(found["ends"].side) == list(results.ends()["side"])
    assert list(found["columns"].ends) == list(results.ends().dtype.names or ())


def test_mat_keeps_every_column_whatever_its_name(tmp_path: Path) -> None:
    scipy_io = pytest.importorskip("scipy.io")
    names = ["a b", "a_b", "a/b", "1", "n" * 70 + "x", "n" * 70 + "y"]
    rows = np.array([tuple(range(6))], dtype=[(name, float) for name in names])
    [path] = _export.write({"some-rows": rows}, "mat", tmp_path, "results")
    found = scipy_io.loadmat(path, squeeze_me=True, struct_as_record=False)
    fields = found["some_rows"]._fieldnames
    assert [getattr(found["some_rows"], field) for field in fields] == list(range(6))
    assert fields[:4] == ["a_b", "a_b_2", "a_b_3", "x1"] and fields[5] == "n" * 61 + "_2"
    assert list(found["columns"].some_rows) == names
    assert [path.name for path in tmp_path.iterdir()] == ["results.mat"]


def test_parquet_holds_a_file_for_each_table(results: Results, tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    results.export("parquet", tmp_path, states=True)
    table = parquet.read_table(tmp_path / "branches.parquet")
    assert table["frequency_hz"].to_pylist() == results.branches()["frequency_hz"].tolist()
    assert table["event"].to_pylist() == results.branches()["event"].tolist()
    states = parquet.read_table(tmp_path / "states.parquet")
    assert states["state"].to_pylist() == results.states()["state"].tolist()


def test_hdf5_holds_a_group_for_each_table(results: Results, tmp_path: Path) -> None:
    h5py = pytest.importorskip("h5py")
    [path] = results.export("hdf5", tmp_path)
    with h5py.File(path) as file:
        np.testing.assert_array_equal(file["branches/frequency_hz"][:], results.branches()["frequency_hz"])
        assert file["branches/event"].asstr()[:].tolist() == results.branches()["event"].tolist()


@pytest.mark.parametrize("format", ["csv", "json", "npz", "mat", "parquet", "hdf5"])
def test_orbits_are_written_in_every_format(results: Results, tmp_path: Path, format: str) -> None:
    pytest.importorskip({"mat": "scipy", "parquet": "pyarrow", "hdf5": "h5py"}.get(format, "numpy"))
    files = results.export_orbits(results.orbits(0.25), format, tmp_path, samples=16)
    assert files and all(path.is_file() for path in files)
    if format == "npz":
        with np.load(files[0]) as found:
            assert len(found["waveforms"]) == 3 * 16 and found["orbits"]["multipliers"].shape == (3, 2)


def test_figures_and_the_page(results: Results) -> None:
    svg = results._repr_svg_()
    assert svg is not None and svg.startswith("<") and "</svg>" in svg
    assert "<iframe" in results.page()._repr_html_()


def test_plots(results: Results) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    axes = results.plot()
    assert axes.get_xlabel() == "Excitation frequency (Hz)"
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["stable", "unstable", "fold"]
    # Two stable parts with an unstable one between them, and its two folds as one line of marks.
    stable, unstable, folds = axes.lines
    np.testing.assert_array_equal(folds.get_xdata(), results.events()["frequency_hz"][:2])
    table = results.branches()
    assert np.isfinite(stable.get_ydata()).sum() == table["stable"].sum()
    assert (np.isfinite(unstable.get_ydata()) >= (table["stability"] == "unstable")).all()
    assert results.orbits(0.25)[0].plot().get_ylabel() == "Displacement of mass (m)"


def test_each_event_has_the_mark_of_hammerbeams_own_figures() -> None:
    from hammerbeam._look import MARKS, marks_of

    rows = [
        ("", "stable", ""),
        ("fold", "marginal", "fold"),
        ("grazing", "unstable", "grazing"),
        ("flip", "unstable", "bifurcation of unstable solutions"),
        ("fold+grazing", "unstable", "fold at a grazing"),
        ("neimark-sacker", "marginal", "Neimark-Sacker"),
        ("branch-point", "stable", "branch point"),
        ("flip", "stable", "flip"),
    ]
    events, stability, expected = (np.array(column) for column in zip(*rows, strict=True))
    assert marks_of(events, stability).tolist() == expected.tolist()
    assert set(expected) - {""} == {mark.name for mark in MARKS}


@pytest.mark.parametrize(
    ("module", "call"),
    [
        ("matplotlib.pyplot", lambda results: results.plot()),
        ("pandas", lambda results: results.frame()),
        ("scipy.io", lambda results: results.export("mat")),
        ("pyarrow", lambda results: results.export("parquet")),
        ("h5py", lambda results: results.export("hdf5")),
    ],
)
def test_a_package_that_is_not_there_is_named(
    results: Results, module: str, call: Callable[[Results], Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    with pytest.raises(hammerbeam.BadInput, match=r"pip install 'hammerbeam\[\w+\]'") as raised:
        call(results)
    assert module.partition(".")[0] in str(raised.value)


def test_results_are_read_by_several_threads_and_closed_by_one(folder: Path) -> None:
    results, found = Results(folder), list[object]()
    first = len(results.branches())

    def work(closes: bool) -> None:
        for turn in range(10):
            try:
                found.append(len(results.branches()) == first and len(results.orbits(0.25)) == 3)
            except Exception as error:
                found.append(type(error))
            if closes and turn == 5:
                results.close()

    threads = [threading.Thread(target=work, args=(number == 0,)) for number in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(60)
    assert len(found) == 30 and set(found) == {True, hammerbeam.ClosedResults}


def test_what_run_reported_is_there(folder: Path) -> None:
    study = Results(folder).study
    again = study.run(folder, progress=False, figures=False)
    assert again.report is not None and again.report["branches"][0]["folds"] == 2


def test_rows_come_into_numpy_without_a_copy() -> None:
    from hammerbeam._tables import array

    rows = np.zeros(1000, dtype=[("branch", "<i8"), ("frequency_hz", "<f8"), ("event", "<U4")])
    fields: list[tuple[str, str, int | None]] = [
        ("branch", "<i8", None),
        ("frequency_hz", "<f8", None),
        ("event", "<U4", None),
    ]
    data = np.frombuffer(rows.tobytes(), dtype=np.uint8)
    table = array(("branches", fields, len(rows), data))
    assert len(table) == len(rows)
    assert np.shares_memory(table, data)


def test_rows_and_numbers_may_be_arrays(results: Results) -> None:
    assert len(results.orbits(np.array([0.25, 0.3]))) == len(results.orbits([0.25, 0.3]))
    assert len(results.branches(np.array([1]))) == len(results.branches(1)) > 0
    assert len(results.branches([])) == 0
    with pytest.raises(hammerbeam.BadInput, match="missing|no number"):
        results.orbits(branch=1)
    with pytest.raises(hammerbeam.BadInput, match="missing|no number"):
        results.orbits([])


def test_a_folder_stays_the_same_when_the_working_directory_changes(
    folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(folder.parent)
    results = Results(folder.name)
    monkeypatch.chdir(tmp_path)
    assert len(results.orbits(0.25)) == 3 and results.folder == folder


def test_a_diagram_that_is_not_there(duffing: hammerbeam.Study, results: Results, tmp_path: Path) -> None:
    with pytest.raises(hammerbeam.BadInput, match="no quantity 'bang'"):
        results.svg("bang")
    duffing.simulate(0.25, periods=2, out=tmp_path / "motion", progress=False)
    motions = Results(tmp_path / "motion")
    assert motions._repr_svg_() is None
    with pytest.raises(hammerbeam.DrawingError, match="no diagram"):
        motions.svg("force")


@pytest.mark.parametrize("format", ["csv", "json", "npz", "mat", "parquet", "hdf5"])
def test_an_export_into_a_file_is_refused(results: Results, tmp_path: Path, format: str) -> None:
    pytest.importorskip({"mat": "scipy", "parquet": "pyarrow", "hdf5": "h5py"}.get(format, "numpy"))
    (tmp_path / "file").write_text("")
    with pytest.raises(hammerbeam.ExportError):
        results.export(format, tmp_path / "file")
    with pytest.raises(hammerbeam.BadInput, match="states"):
        results.export(format, tmp_path / "folder", states="yes")  # type: ignore[arg-type]
    with pytest.raises(hammerbeam.BadInput, match="orbits"):
        results.export_orbits(list(results.orbits(0.25)), format, tmp_path)  # type: ignore[arg-type]


def test_folders_to_start_from_are_a_list(duffing: hammerbeam.Study, tmp_path: Path) -> None:
    with pytest.raises(hammerbeam.BadInput, match="start_from.*list"):
        duffing.run(tmp_path / "out", start_from="abc", progress=False)
