"""Bad input: exceptions with the words of the command, and nothing that aborts the interpreter."""

import json
import os
import pickle
import random
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import hammerbeam
import numpy as np
import pytest
from conftest import ROOT, STUDIES, changed
from hammerbeam import BadInput, HammerbeamError, Results, Study
from test_study import OSCILLATOR, chain


def command() -> Path | None:
    """The command, if it is built."""
    given = os.environ.get("HAMMERBEAM_COMMAND")
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    candidates = [Path(given)] if given else [target / "debug/hammerbeam", target / "release/hammerbeam"]
    return next((path for path in candidates if path.is_file()), None)


def test_faults_of_a_study_are_those_of_the_command(tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    path.write_text(changed("duffing.toml", "mass_kg = 1.0", "mass_kg = -1.0"))
    with pytest.raises(hammerbeam.StudyError) as raised:
        Study.read(path)
    error = raised.value
    assert error.exit_code == 2 and error.name == "Invalid"
    [problem] = error.problems
    assert problem["key"] == "structure.mass[0].mass_kg" and problem["line"] == 13
    if (program := command()) is None:
        pytest.skip("the command is not built")
    told = subprocess.run([program, "check", path, "--json"], capture_output=True, text=True)
    assert told.returncode == error.exit_code
    document = json.loads(told.stdout)["error"]
    assert document["message"] == str(error) and document["problems"] == error.problems


@pytest.mark.parametrize(
    ("arguments", "call", "words"),
    [
        (
            "orbit S --frequency 0.25 --period-multiple 65",
            lambda s: s.orbits(0.25, 65),
            "65 is not in 1..=64",
        ),
        (
            "orbit S --frequency nan",
            lambda s: s.orbits(float("nan")),
            "must be a number of hertz from 1e-10 to 1e10",
        ),
        ("lyapunov S --frequency 0.25 --to 0.2", lambda s: s.lyapunov(0.25, 0.2), "0.2 Hz, which is below"),
        (
            "lyapunov S --frequency 0.25 --periods 3",
            lambda s: s.lyapunov(0.25, periods=3),
            "3 is not in 20..=100000000",
        ),
        (
            "simulate S --frequency 0.25 --initial 1,2,3",
            lambda s: s.simulate(0.25, initial=[1, 2, 3]),
            "found 3 numbers",
        ),
        (
            "simulate S --frequency 0.25 --initial what",
            lambda s: s.simulate(0.25, initial="what"),
            'found "what"; allowed',
        ),
        (
            "basins S --frequency 0.25 --x q1=-1..1 --y q7=-1..1",
            lambda s: s.basins(0.25, ("q1", -1, 1), ("q7", -1, 1)),
            "allowed: q1 to q1, v1 to v1",
        ),
    ],  # fmt: skip
)
def test_words_and_exit_codes_are_those_of_the_command(
    duffing: Study, arguments: str, call: Callable[[Study], Any], words: str
) -> None:
    with pytest.raises(BadInput) as raised:
        call(duffing)
    assert words in str(raised.value)
    if (program := command()) is None:
        pytest.skip("the command is not built")
    line = [str(STUDIES / "duffing.toml") if word == "S" else word for word in arguments.split()]
    told = subprocess.run([program, *line], capture_output=True, text=True)
    assert told.returncode == raised.value.exit_code == 2
    assert words in " ".join(told.stderr.split())


@pytest.mark.parametrize("name", ["M", "K", "C"])
@pytest.mark.parametrize("keep", [np.triu, np.tril, lambda whole: whole + np.diag([1.0, 0.0, 0.0], 1)])
@pytest.mark.parametrize("sparse", [False, True])
def test_an_unsymmetric_matrix_is_refused_with_its_place(
    name: str, keep: Callable[[np.ndarray], np.ndarray], sparse: bool
) -> None:
    _, stiffness = chain(4)
    given: dict[str, Any] = {"M": stiffness, "K": stiffness, "C": stiffness}
    given[name] = keep(stiffness)
    if sparse:
        scipy_sparse = pytest.importorskip("scipy.sparse")
        given = {key: scipy_sparse.csr_array(matrix) for key, matrix in given.items()}
    with pytest.raises(hammerbeam.StudyError, match=f"matrix {name} is not symmetric") as raised:
        Study.from_matrices(**given, points={"tip": 3}, reduction={"method": "none"})
    numbers = raised.value.numbers
    assert raised.value.name == "NotSymmetric" and numbers["value"] != numbers["mirrored"]
    assert sorted([numbers["row"], numbers["column"]])[1] <= 4


def test_rounding_does_not_make_a_matrix_unsymmetric_and_the_matrix_stays_as_it_was() -> None:
    sparse = pytest.importorskip("scipy.sparse")
    rows, columns = [0, 0, 0, 1, 1], [0, 0, 1, 0, 1]
    stiffness = sparse.coo_array(([150.0, 150.0, -100.0, -100.0 * (1 + 1e-12), 100.0], (rows, columns)))
    study = Study.from_matrices(np.eye(2), stiffness, points={"tip": 1}, reduction={"method": "none"})
    assert study.dof == 2 and stiffness.nnz == 5


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"K": None}, "K: found None"),
        ({"M": None}, "M: found None"),
        ({"fixed": 1}, "must be a list of rows"),
        ({"fixed": "a"}, "must be a list of rows"),
        ({"folder": Path(__file__)}, "folder: "),
    ],
)
def test_what_is_given_with_matrices(given: dict[str, Any], words: str) -> None:
    mass, stiffness = chain(2)
    arguments = {"M": mass, "K": stiffness, "points": {"tip": 1}, "reduction": {"method": "none"}, **given}
    with pytest.raises(BadInput, match=words):
        Study.from_matrices(**arguments)


def test_a_study_is_not_made_of_a_file_name() -> None:
    with pytest.raises(BadInput, match=r"Study\.read"):
        Study("duffing.toml")  # type: ignore[arg-type]
    with pytest.raises(BadInput, match="settings"):
        Study.from_dict(OSCILLATOR).text_with([("stop", 1)])  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("mass", "stiffness", "words"),
    [
        (np.eye(3), np.eye(4), "row"),
        (np.eye(3), np.ones((3, 2)), "square"),
        (np.eye(3), np.ones(3), "square"),
        (np.eye(3), "K", "square"),
        (np.full((2, 2), np.nan), np.eye(2), "K.mtx|M.mtx"),
        (np.eye(2) * 1j, np.eye(2), "real numbers"),
        (np.eye(2), [[1, 2], [3]], "K"),
        (np.zeros((0, 0)), np.zeros((0, 0)), "square"),
    ],
)
def test_matrices_that_are_none(mass: Any, stiffness: Any, words: str) -> None:
    with pytest.raises(HammerbeamError, match=words):
        Study.from_matrices(mass, stiffness, points={"tip": 0}, reduction={"method": "none"})


def test_a_complex_number_is_no_frequency(duffing: Study) -> None:
    for frequency in (0.25 + 3j, np.complex128(0.25 + 3j)):
        with pytest.raises(hammerbeam.BadInput, match="frequency"):
            duffing.orbits(frequency)  # type: ignore[arg-type]


def test_a_closed_folder_raises_and_other_results_go_on(folder: Path) -> None:
    results = Results(folder)
    orbits = results.orbits(0.25)
    results.page()
    results.close()
    results.close()
    calls: list[Callable[[], Any]] = [
        results.branches, results.events, results.svg, results.export, results.page, results.__enter__,
        lambda: results.orbits(0.25), lambda: results.export_orbits(orbits),
    ]  # fmt: skip
    for call in calls:
        with pytest.raises(hammerbeam.ClosedResults, match="closed"):
            call()
    assert results.closed and len(orbits[0].waveform(4)) == 4
    with Results(folder) as other:
        assert len(other.branches()) > 0


def test_a_folder_that_was_deleted(folder: Path, tmp_path: Path) -> None:
    shutil.copytree(folder, tmp_path / "copy")
    results = Results(tmp_path / "copy")
    shutil.rmtree(tmp_path / "copy")
    for call in (lambda: results.orbits(0.25), results.svg, results.page, results.draw):
        with pytest.raises(hammerbeam.StoreError, match="there are no results") as raised:
            call()
        assert raised.value.name == "NoResults"
    assert "copy" in repr(results)
    results.close()
    assert not (tmp_path / "copy").exists()


def test_a_folder_without_results(tmp_path: Path) -> None:
    with pytest.raises(hammerbeam.StoreError, match="there are no results") as raised:
        Results(tmp_path)
    assert raised.value.name == "NoResults" and raised.value.exit_code == 2


def test_a_folder_of_another_study(folder: Path, oscillator: Study) -> None:
    with pytest.raises(hammerbeam.StoreError, match="another study") as raised:
        oscillator.run(folder, progress=False)
    assert raised.value.name == "OtherStudy" and raised.value.numbers["differences"]


def test_an_object_works_after_an_error(duffing: Study) -> None:
    with pytest.raises(BadInput):
        duffing.orbit("fast")  # type: ignore[arg-type]
    assert len(duffing.orbits(0.25)) == 3


def test_errors_carry_their_numbers(duffing: Study) -> None:
    with pytest.raises(hammerbeam.FallingFrequencies) as raised:
        duffing.lyapunov(0.3, 0.2)
    assert raised.value.numbers == {"from_hz": 0.3, "to_hz": 0.2}
    again = pickle.loads(pickle.dumps(raised.value))
    assert again.numbers == raised.value.numbers and str(again) == str(raised.value)


def test_ranges_are_numbers_of_the_error(duffing: Study) -> None:
    with pytest.raises(BadInput) as raised:
        duffing.orbits(0.25, 65)
    assert raised.value.numbers == {"found": 65, "low": 1, "high": 64}
    with pytest.raises(BadInput) as raised:
        duffing.orbits(1e11)
    assert raised.value.numbers == {"found": 1e11, "low": 1e-10, "high": 1e10}


def test_a_warning_is_one() -> None:
    tables: dict[str, Any] = {
        **OSCILLATOR,
        "structure": {
            "kind": "lumped",
            "mass": [{"name": "mass", "mass_kg": 1.0}],
            "damper": [{"between": ["mass", "ground"], "damping_n_s_m": 0.1}],
        },
    }
    tables["stop"] = [{"at": "mass", "law": "linear", "stiffness_n_m": 10.0, "gap_m": 0.1, "side": "above"}]
    study = Study.from_dict(tables)
    try:
        with pytest.warns(hammerbeam.HammerbeamWarning):
            study.orbits(0.15)
    except HammerbeamError as error:
        assert error.exit_code in (1, 2)


@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_ctrl_c_keeps_what_is_done(tmp_path: Path) -> None:
    script = f"""
import hammerbeam, signal, sys
# A shell that starts the tests in the background lets its children ignore Ctrl-C.
signal.signal(signal.SIGINT, signal.default_int_handler)
study = hammerbeam.Study.read({str(STUDIES / "beam-with-stop.toml")!r})
print("started", flush=True)
try:
    study.run({str(tmp_path / "out")!r}, progress=False)
except hammerbeam.Interrupted as error:
    print(error)
    sys.exit(error.exit_code)
"""
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True)
    assert process.stdout is not None and process.stdout.readline() == "started\n"
    for _ in range(300):
        time.sleep(0.1)
        if (tmp_path / "out/results.db").exists():
            break
    time.sleep(1.0)
    process.send_signal(signal.SIGINT)
    out, _ = process.communicate(timeout=60)
    assert process.returncode == 130 and "is kept in" in out
    assert isinstance(Results(tmp_path / "out").branches(), np.ndarray)


def test_progress_from_another_thread_is_not_interrupted(duffing: Study, tmp_path: Path) -> None:
    errors: list[BaseException] = []

    def work() -> None:
        try:
            duffing.run(tmp_path / "out", jobs=1, progress=False, figures=False)
        except BaseException as error:
            errors.append(error)

    thread = threading.Thread(target=work)
    thread.start()
    thread.join()
    assert not errors
