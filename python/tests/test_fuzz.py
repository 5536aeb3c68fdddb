"""Thousands of calls with what makes no sense: each raises an error of ours, none aborts the interpreter."""

import os
import random
import shutil
from collections.abc import Callable, Hashable
from pathlib import Path
from typing import Any

import hammerbeam
import numpy as np
import pytest
from conftest import STUDIES
from hammerbeam import HammerbeamError, Results, Study, batch, dakota
from hammerbeam.batch import Batch, Parameters, Task
from test_study import OSCILLATOR

VALUES: list[Any] = [
    None, True, False, -1, 0, 1, 2, 2**70, -0.0, 0.25, 1e400, -1e-300, float("nan"),
    "0.25", "", "\0", "rest", "\ud800", "mass", "csv", "npz", "a,b\n1,2", b"x",
    [], [1.0], [1.0, float("nan")], [[]], [None], (),
    ("q1", -1.0, 1.0), ("q1", 1.0, -1.0), ("q1", "a", 1), (1, 2), (0.0, 1.0),
    {}, {"a": 1}, {"a": [1.0]}, {"a": (0.0, 1.0)}, {1: [2]}, {"mass.y": 1.0}, {"": [1]},
    {"a": {}}, {"a": object()}, {"figures": 1}, np.float64(0.25), np.int32(3), np.bool_(True),
    np.array(0.25), np.zeros(3), np.zeros((2, 2)), np.array(["a"]), np.array([1, "a"], dtype=object),
    object(), 1j, print, {1, 2}, range(3), Path("nowhere"), Path(), Path("nothing/below"),
]  # fmt: skip
"""What is given. Relative paths are below a temporary folder."""

Call = tuple[Callable[..., Any], int]
"""What is called, with how many of the values."""


def keyed(key: Any, value: Any) -> dict[Any, Any]:
    """A dictionary with a key of any type that a dictionary takes."""
    return {key if isinstance(key, Hashable) else str(key): value}


def calls_of_studies(study: Study) -> list[Call]:
    quiet: dict[str, Any] = {"progress": False}
    return [
        (Study.read, 1), (Study.parse, 2), (Study.from_dict, 2), (Study, 1), (Study, 2),
        (lambda m, k, c, p: Study.from_matrices(m, k, c, points=p), 4),
        (lambda p, f, o: Study.from_matrices(np.eye(2), np.eye(2), points=p, fixed=f, folder=o), 3),
        (lambda s: Study.from_matrices(np.eye(2), np.eye(2), points={"a": 1}, structure=s), 1),
        (lambda e, s, p: Study.from_dict({**OSCILLATOR, "excitation": e, "stop": s, "response": p}), 3),
        (study.text_with, 1), (study.with_values, 1), (study.placed, 1),
        (lambda v: study.text_with({"excitation.amplitude_n": v}), 1),
        (lambda k, v: study.with_values(keyed(k, v)), 2),
        (lambda v: study.with_values({"structure.mass.1.mass_kg": v}), 1),
        (lambda f, m: study.orbits(f, m, **quiet), 2), (lambda f, p: study.orbit(f, progress=p), 2),
        (lambda f, p, i: study.simulate(f, periods=p, initial=i, samples_per_period=4, **quiet), 3),
        (lambda f, d, s: study.simulate(f, duration_s=d, sampling_hz=s, **quiet), 3),
        (lambda t, s, r: study.simulate(0.25, periods=1, transient_periods=t, section_phase=s, results=r), 3),
        (lambda a, b, c, n: study.sweep(a, b, c, samples=n, patience_periods=5, **quiet), 4),
        (lambda s, i, d: study.sweep(0.2, 0.2, starts=s, initial=i, down=d, patience_periods=5), 3),
        (lambda s, p: study.sweep(0.2, 0.2, starts=s, parts=p, patience_periods=5), 2),
        (lambda p, o, s: study.sweep_part(p, o, starts=s, from_hz=0.2, to_hz=0.2, patience_periods=5), 3),
        (lambda a, b, c, p: study.lyapunov(a, b, c, periods=p, **quiet), 4),
        (lambda i, s, t: study.lyapunov(0.25, periods=20, initial=i, sections_per_period=s, results=t), 3),
        (lambda f, x, y, g: study.basins(f, x, y, g, patience_periods=3, **quiet), 4),
        (lambda p, o, x: study.basins_part(p, o, frequency_hz=0.25, x=x, y=("v1", -1.0, 1.0), grid=2), 3),
        (lambda o, j, s: study.run(o, j, start_from=s, figures=False, **quiet), 3),
    ]  # fmt: skip


def calls_of_results(results: Results) -> list[Call]:
    orbits = results.orbits(0.25)
    return [
        (Results, 1), (results.branches, 1), (results.states, 1), (results.frame, 1), (hammerbeam.frame, 1),
        (lambda f, b, e: results.orbits(f, branch=b, event=e), 3),
        (lambda f, o, s: results.export(f, o, states=s), 3),
        (lambda o, s: results.export("npz", o, states=s), 2),
        (lambda o, f, p, n: results.export_orbits(o, f, p, samples=n), 4),
        (lambda f, p, n: results.export_orbits(orbits[:1], f, p, samples=n), 3),
        (lambda p, n: results.export_orbits(orbits, "csv", p, samples=n), 2),
        (lambda n: orbits[0].waveform(n), 1), (lambda a, p: orbits[0].plot(a, p), 2),
        (lambda q, a: results.plot(q, a), 2), (results.svg, 1),
        (lambda k, f, r: results.draw("drawn", kinds=k, formats=f, resolution=r, progress=False), 3),
        (lambda p: results.draw("drawn", kinds="response", formats="svg", progress=p), 1),
    ]  # fmt: skip


def calls_of_parameters() -> list[Call]:
    table = Parameters.grid({"a": [1, 2]})
    return [
        (Parameters, 2), (lambda r: Parameters(["a"], r), 1), (Parameters.grid, 1),
        (lambda v: Parameters.grid({"a": v}), 1), (lambda k, v: Parameters.grid(keyed(k, [v])), 2),
        (Parameters.latin_hypercube, 3), (lambda r: Parameters.latin_hypercube({"a": r}, 3, 1), 1),
        (lambda c, s: Parameters.latin_hypercube({"a": (0.0, 1.0)}, c, s), 2),
        (Parameters.parse, 1), (Parameters.read, 1), (table.column, 1), (table.settings, 1),
        (Task, 3), (lambda o: Task("simulate", o), 1), (lambda f: Task.run(figures=f), 1),
        (lambda f, p, i: Task.simulate(f, periods=p, initial=i).document(), 3),
        (lambda p, s, d: Task.sweep(parts=p, starts=s, down=d), 3), (Task.lyapunov, 1),
        (lambda f, x, y, p: Task.basins(f, x, y, parts=p), 4), (Task.from_document, 1),
        (lambda m, o, p: Task.from_document({"method": m, "options": o, "parts": p}), 3),
        (dakota.parse, 1), (dakota.respond, 2),
    ]  # fmt: skip


def calls_of_batches(planned: Batch) -> list[Call]:
    table = planned.parameters
    return [
        (Batch, 1), (Batch.plan, 4), (lambda s, t: Batch.plan("planned", s, table, t), 2),
        (lambda f: Batch.plan(f, STUDIES / "duffing.toml", table), 1),
        (planned.item, 1), (planned.row, 1), (planned.part, 1), (planned.numbers_of, 1), (planned.whole, 1),
        (planned.compute, 2), (planned.merge, 1), (lambda e, a: planned.run(e, attempts=a), 2),
        (lambda p: planned.run(attempts=1, progress=p), 1),
        (lambda q, a: planned.gather().plot(q, a), 2), (lambda f: planned.gather().write(f), 1),
        (batch.Local, 1), (lambda s, c, o: batch.HyperQueue(s, cpus=c, options=o), 3), (batch.Dask, 1),
        (batch.slurm_script, 2),
        (lambda p, c, t, o: batch.slurm_script(planned, p, cpus=c, tasks=t, options=o), 4),
    ]  # fmt: skip


@pytest.fixture
def planned(tmp_path: Path) -> Batch:
    """A batch all of whose items are finished, so that running it computes nothing."""
    table = Parameters.grid({"search.frequencies": [1]})
    made = Batch.plan(tmp_path / "batch", STUDIES / "duffing.toml", table)
    assert made.run(batch.Local(1), progress=False).finished == 1
    return made


def test_thousands_of_bad_calls_raise_and_abort_nothing(
    duffing: Study, results: Results, planned: Batch, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "below").mkdir()
    monkeypatch.chdir(tmp_path / "below")
    of_package = [calls_of_studies(duffing), calls_of_results(results)]
    groups = [*of_package, calls_of_parameters(), calls_of_batches(planned)]
    pick = random.Random(int(os.environ.get("HAMMERBEAM_FUZZ_SEED", "1")))
    count = int(os.environ.get("HAMMERBEAM_FUZZ", "6000"))
    refused = 0
    for number in range(count):
        call, size = pick.choice(groups[number % len(groups)])
        arguments = [pick.choice(VALUES) for _ in range(size)]
        try:
            call(*arguments)
        except HammerbeamError as error:
            assert error.exit_code in (1, 2) and str(error)
            refused += 1
        except Exception as error:
            raise AssertionError(f"call {number}: {arguments!r}: {error!r}") from error
    assert refused > count / 2
    # Nothing that was given has harmed them, or lies beside the folder.
    assert len(duffing.orbits(0.25)) == 3 and len(results.branches()) > 100
    shutil.rmtree(tmp_path / "below")
    assert {path.name for path in tmp_path.iterdir()} == {"batch"}
