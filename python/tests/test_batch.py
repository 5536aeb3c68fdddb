"""Batches: planning, status, what is missing, one table."""

import csv
import os
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import hammerbeam
import numpy as np
import pytest
from conftest import ROOT, STUDIES
from hammerbeam import batch
from hammerbeam.batch import Batch, Local, Parameters, Status, Task
from hammerbeam.batch.__main__ import main as terminal

EXAMPLE = ROOT / "python/examples/dakota/oscillator.toml"
GAP = "stop.stop.gap_m"


@pytest.fixture(scope="module")
def memory(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A folder that is no disk, where there is one: the disk of a busy machine is not what is tested."""
    shared = Path("/dev/shm")
    if not os.access(shared, os.W_OK):
        yield tmp_path_factory.mktemp("many")
        return
    folder = shared / f"hammerbeam-{os.getpid()}"
    folder.mkdir()
    yield folder
    shutil.rmtree(folder)


@pytest.fixture(scope="module")
def file_calls() -> Iterator[Counter[str]]:
    """How often Python asked the system for a file or a folder since it was cleared."""
    calls, counts = Counter[str](), True

    def note(event: str, _: tuple[object, ...]) -> None:
        if counts and event in ("open", "os.mkdir", "os.rename", "os.listdir", "os.scandir", "os.remove"):
            calls[event] += 1

    # A hook cannot be taken away again.
    sys.addaudithook(note)
    yield calls
    counts = False


def test_values_are_placed_as_the_command_places_them(tmp_path: Path) -> None:
    planned = Batch.plan(tmp_path / "b", EXAMPLE, Parameters.grid({GAP: [0.9], "response.point": ["mass"]}))
    text = planned.item(1).study.read_text()
    assert "gap_m = 0.9" in text and 'point = "mass"' in text
    command = ROOT / os.environ.get("CARGO_TARGET_DIR", "target") / "debug/hammerbeam"
    if command.is_file():
        asked: list[Any] = [
            command,
            "check",
            EXAMPLE,
            "--set",
            f"{GAP}=0.9",
            "--set",
            "response.point=mass",
            "--json",
        ]
        by_command = subprocess.run(asked, capture_output=True, text=True, check=True).stdout
        own: list[Any] = [command, "check", planned.item(1).study, "--json"]
        assert subprocess.run(own, capture_output=True, text=True, check=True).stdout == by_command


def test_two_keys_of_a_table_that_the_study_does_not_have() -> None:
    study = hammerbeam.Study.read(ROOT / "studies/impact-oscillator.toml")
    text = study.text_with({"search.frequencies": 3, "search.starts": 2})
    assert text.startswith("search.starts = 2\nsearch.frequencies = 3\n")


def test_a_wrong_key_or_value_is_refused_before_anything_is_made(tmp_path: Path) -> None:
    for values in ({"stop.other.gap_m": [1.0]}, {GAP: [1.0, -1.0]}, {"stop.stop.gab_m": [1.0]}):
        with pytest.raises(hammerbeam.StudyError):
            Batch.plan(tmp_path / "b", EXAMPLE, Parameters.grid(values))
        with pytest.raises(hammerbeam.BadInput, match="no batch folder"):
            Batch(tmp_path / "b")
    with pytest.raises(hammerbeam.BadInput, match="allowed: frequency_hz"):
        Task.basins(0.2, ("q1", -1, 1), ("v1", -1, 1), other=3)
    with pytest.raises(hammerbeam.BadInput, match="allowed: with starts"):
        Task.sweep(parts=3)


def test_ten_thousand_items_are_planned_with_a_folder_and_a_file_each(
    memory: Path, file_calls: Counter[str]
) -> None:
    table = Parameters.latin_hypercube(
        {GAP: (0.8, 1.2), "structure.damper.1.damping_n_s_m": (0.02, 0.06)}, 10_000, seed=1
    )
    file_calls.clear()
    planned = Batch.plan(memory / "many", EXAMPLE, table)
    counts = planned.counts()
    # Seconds are those of the machine (python/measure.py takes them); what is done for an item is not.
    assert file_calls["open"] < 10_100 and file_calls.total() < 20_500, file_calls
    assert counts.missing == counts.items == 10_000
    # None of its folders is too long to be listed.
    assert max(len(files) + len(folders) for _, folders, files in os.walk(planned.folder)) <= 100


def grazing_hz(gap: float) -> float:
    """Where the linear amplitude of the example, 0.4/|1 - W^2 + 0.04 i W|, first reaches the gap."""
    squares = np.roots([1, 0.04**2 - 2, 1 - (0.4 / gap) ** 2])
    return float(np.sqrt(squares.real.min()) / (2 * np.pi))


def test_a_batch_is_run_and_gathered(tmp_path: Path) -> None:
    gaps = [0.8, 1.0, 1.2]
    planned = Batch.plan(tmp_path / "b", EXAMPLE, Parameters.grid({GAP: gaps}))
    assert planned.run(Local(2)).finished == 3
    gathered = planned.gather()
    np.testing.assert_allclose(
        gathered.table["lowest_grazing_hz"], [grazing_hz(gap) for gap in gaps], rtol=1e-6
    )
    np.testing.assert_allclose(gathered.table["max_abs_displacement_m"], gaps, rtol=1e-6)
    assert set(gathered.branches()["row"]) == {1, 2, 3}
    files = gathered.write()
    rows = list(csv.DictReader(files[0].open(newline="")))
    assert [row["status"] for row in rows] == ["finished"] * 3 and [float(row[GAP]) for row in rows] == gaps
    pytest.importorskip("matplotlib")
    assert files[1].read_text().count("</svg>") == 1


def test_only_missing_items_are_computed(tmp_path: Path) -> None:
    planned = Batch.plan(tmp_path / "b", EXAMPLE, Parameters.grid({GAP: [0.9, 1.0]}))
    assert planned.compute(1) is Status.FINISHED
    before = planned.item(1).report.stat()
    assert planned.missing() == [2] and planned.run(Local(1)).finished == 2
    after = planned.item(1).report.stat()
    assert (before.st_ino, before.st_mtime_ns) == (after.st_ino, after.st_mtime_ns)
    # Neither a report alone nor results alone are a product.
    shutil.rmtree(planned.item(1).results)
    (planned.item(2).report).unlink()
    assert planned.statuses() == [Status.MISSING, Status.STARTED]
    # The same plan opens the folder, another one is refused.
    assert len(Batch.plan(tmp_path / "b", EXAMPLE, Parameters.grid({GAP: [0.9, 1.0]}))) == 2
    with pytest.raises(hammerbeam.BadInput, match="parameters.csv"):
        Batch.plan(tmp_path / "b", EXAMPLE, Parameters.grid({GAP: [0.9, 1.1]}))


def test_how_far_a_batch_is_is_reported_whatever_the_engine(tmp_path: Path) -> None:
    reports = list[tuple[float | None, str]]()

    class Slow:
        """Computes one item after the other, and waits until it was seen."""

        def compute(self, batch: Batch, numbers: Sequence[int]) -> None:
            for done, number in enumerate(numbers, 1):
                batch.compute(number)
                while (done / 2, f"{done} of 2 items are finished") not in reports:
                    time.sleep(0.05)

    planned = Batch.plan(tmp_path / "b", EXAMPLE, Parameters.grid({GAP: [0.9, 1.0]}))
    planned.run(Slow(), progress=lambda fraction, text: reports.append((fraction, text)))
    assert reports[-1] == (1.0, "2 of 2 items are finished")
    assert [fraction for fraction, _ in reports] == sorted(fraction or 0.0 for fraction, _ in reports)


def test_why_an_item_failed_is_kept_until_it_is_finished(tmp_path: Path) -> None:
    table = Parameters.grid({"excitation.frequency_hz": [[0.11, 0.14], [1e9, 1.1e9]]})
    planned = Batch.plan(tmp_path / "b", EXAMPLE, table)
    counts = planned.run(Local(1))
    assert (counts.finished, counts.failed) == (1, 1)
    assert list(planned.failures()) == [2] and planned.failures()[2]
    asked = [sys.executable, "-m", "hammerbeam.batch", "item", str(planned.folder), "2"]
    done = subprocess.run(asked, capture_output=True, text=True)
    assert done.returncode in (1, 2) and done.stderr.startswith("item 2: ")


def test_a_slurm_array_computes_what_is_missing(tmp_path: Path) -> None:
    planned = Batch.plan(tmp_path / "b", EXAMPLE, Parameters.grid({GAP: [0.9, 1.0, 1.1]}))
    planned.compute(1)
    script = batch.slurm_script(planned, options=["--time=00:10:00"], tasks=2)
    text = script.read_text()
    assert "#SBATCH --array=0-1\n" in text and "#SBATCH --time=00:10:00\n" in text
    for task in ("0", "1"):
        environment = {**os.environ, "SLURM_ARRAY_TASK_ID": task}
        subprocess.run(["bash", script], env=environment, check=True)
    assert planned.counts().finished == 3
    with pytest.raises(hammerbeam.BadInput, match="all items are finished"):
        batch.slurm_script(planned)


def test_a_slurm_script_quotes_its_folder(tmp_path: Path) -> None:
    planned = Batch.plan(tmp_path / "b %j", EXAMPLE, Parameters.grid({GAP: [0.9]}))
    lines = batch.slurm_script(planned).read_text().splitlines()
    assert "#SBATCH --job-name='b %j'" in lines
    assert f"#SBATCH --output='{tmp_path}/b %%j/slurm/%A-%a.txt'" in lines


def test_a_batch_from_a_terminal(tmp_path: Path) -> None:
    def asked(*words: str) -> str:
        command = [sys.executable, "-m", "hammerbeam.batch", *words]
        return subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True).stdout

    (tmp_path / "gaps.csv").write_text(f"{GAP}\n0.9\n1.1\n")
    assert asked("plan", "b", str(EXAMPLE), "gaps.csv").startswith("0 of 2")
    assert asked("run", "b", "--processes", "2").startswith("2 of 2")
    assert asked("gather", "b").splitlines()[0].endswith("gathered.csv")
    (tmp_path / "no-text.csv").write_bytes(b"\xff\xfe")
    for table, words in (("missing.csv", "No such file"), ("no-text.csv", "is no text")):
        with pytest.raises(subprocess.CalledProcessError) as error:
            asked("plan", "other", str(EXAMPLE), table)
        assert error.value.returncode == 2 and words in error.value.stderr


def test_samples_from_a_terminal_are_those_of_the_class(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def planned(name: str, *words: str) -> tuple[int, str]:
        code = terminal(["plan", str(tmp_path / name), str(EXAMPLE), *words])
        said = capsys.readouterr()
        return code, said.out + said.err

    force = "excitation.amplitude_n"
    ranges = ("--latin", f"{GAP}=0.8:1.2", "--latin", f"{force}=0.2:3e-1", "--samples", "5")
    assert planned("b", *ranges, "--seed", "3")[0] == 0
    expected = Parameters.latin_hypercube({GAP: (0.8, 1.2), force: (0.2, 0.3)}, 5, seed=3)
    made = Batch(tmp_path / "b")
    assert (made.parameters.rows, made.task) == (expected.rows, Task.run())
    grid = ("--grid", f"{GAP}=0.8,1.2", "--grid", f"{force}=0.2,0.3 N,0.4")
    assert planned("g", *grid)[1].startswith("0 of 6")
    every = Parameters.grid({GAP: ["0.8", "1.2"], force: ["0.2", "0.3 N", "0.4"]})
    assert Batch(tmp_path / "g").parameters.rows == every.rows
    (tmp_path / "sweep.json").write_text('{"method": "sweep", "options": {"starts": 4}, "parts": 2}')
    assert planned("s", *ranges, "--task", str(tmp_path / "sweep.json"))[1].startswith("0 of 10")
    assert Batch(tmp_path / "s").task == Task.sweep(starts=4, parts=2)
    (tmp_path / "t.json").write_text('{"method": "sweep"}')
    for given, words in (
        ((), "which studies are meant is missing"),
        (("--latin", f"{GAP}=0:1"), "with --samples N"),
        (("--latin", f"{GAP}=0.8", "--samples", "2"), "must be KEY=LOW:HIGH"),
        (("--latin", f"{GAP}=2:1", "--samples", "2"), "is empty"),
        (("--latin", f"{GAP}=nan:1", "--samples", "2"), "nan"),
        ((*ranges, "--latin", f"{GAP}=1:2"), "the same key is given twice"),
        (("gaps.csv", "--seed", "1"), "one of a table, --grid, and --latin"),
        ((*ranges, "--grid", f"{GAP}=1,2"), "one of a table, --grid, and --latin"),
        (("--grid", f"{GAP}=1,,2"), "must be KEY=VALUE,VALUE,..."),
        (("--grid", f"{GAP}=1", "--grid", f"{GAP}=2"), "the same key is given twice"),
        ((*ranges, "--task", str(tmp_path / "t.json")), "must have method, options and parts"),
    ):
        code, said = planned("n", *given)
        assert code == 2 and words in said, said
    assert not (tmp_path / "n").exists()


def test_matrices_of_arrays_go_with_the_batch(tmp_path: Path) -> None:
    study = hammerbeam.Study.from_matrices(
        np.diag([2.0, 1.0]),
        np.array([[300.0, -100.0], [-100.0, 100.0]]),
        points={"base": 0, "tip": 1},
        excitation={"kind": "force", "at": "base", "amplitude_n": 1.0, "frequency_hz": [0.5, 0.6]},
        damping={"modal_ratio": 0.02},
        reduction={"method": "none"},
        response={"point": "tip"},
        search={"frequencies": 1, "starts": 1, "trials": 0},
        continuation={"max_step_hz": 0.01},
    )
    planned = Batch.plan(tmp_path / "b", study, Parameters.grid({"excitation.amplitude_n": [1.0, 2.0]}))
    del study
    assert planned.run(Local(1)).finished == 2
    one, two = planned.gather().table["max_abs_displacement_m"]
    assert two == pytest.approx(2 * one, rel=1e-9)


def test_a_killed_process_loses_no_item(tmp_path: Path) -> None:
    psutil = pytest.importorskip("psutil")
    planned = Batch.plan(tmp_path / "b", EXAMPLE, Parameters.grid({GAP: [0.8 + 0.05 * k for k in range(8)]}))
    with ThreadPoolExecutor(1) as pool:
        running = pool.submit(planned.run, Local(2))
        while not planned.counts().finished:
            time.sleep(0.01)
        [one, _] = [child for child in psutil.Process().children() if "hammerbeam.batch" in child.cmdline()]
        one.kill()
        assert running.result().finished == 8


def test_ctrl_c_keeps_what_is_finished(tmp_path: Path) -> None:
    gaps = [0.8 + 0.001 * k for k in range(400)]
    planned = Batch.plan(tmp_path / "b", EXAMPLE, Parameters.grid({GAP: gaps}))
    # Where the tests themselves are told to pass over Ctrl-C, as behind `nohup`, this process is not.
    listens = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"
    runs = f"from hammerbeam.batch import Batch, Local; Batch({str(planned.folder)!r}).run(Local(2))"
    script = f"{listens}; {runs}"
    # A group of its own, as a terminal has it: all processes get the signal. So many items that some are left
    # however late it comes.
    asked = [sys.executable, "-c", script]
    running = subprocess.Popen(asked, stderr=subprocess.PIPE, text=True, start_new_session=True)
    while planned.counts().finished < 4:
        time.sleep(0.01)
    os.killpg(running.pid, signal.SIGINT)
    _, said = running.communicate(timeout=60)
    assert running.returncode != 0 and "the same call goes on from there" in said
    assert 4 <= planned.counts().finished < 400
    assert planned.counts().failed == 0


def test_what_a_batch_is_not_made_of(tmp_path: Path) -> None:
    from hammerbeam import BadInput

    file = tmp_path / "file"
    file.write_text("")
    table = Parameters.grid({"stop.1.gap_m": [0.1]})
    study = STUDIES / "duffing.toml"
    calls: list[Any] = [
        lambda: Parameters.grid(3),  # type: ignore[arg-type]
        lambda: Parameters.grid({"a": 3}),  # type: ignore[dict-item]
        lambda: Parameters.parse(3),  # type: ignore[arg-type]
        lambda: table.column("b"),
        lambda: Task.basins(0.2, 5, ("v1", -1, 1)),
        lambda: Task.simulate(float("nan")),
        lambda: Task.simulate("fast"),  # type: ignore[arg-type]
        lambda: Task.simulate(()),  # type: ignore[arg-type]
        lambda: Batch.plan(tmp_path / "batch", study, [1]),  # type: ignore[arg-type]
        lambda: Batch.plan(tmp_path / "batch", study, table, "run"),  # type: ignore[arg-type]
        lambda: Batch.plan(file, study, table),
        lambda: batch.Dask(None),
    ]
    for number, call in enumerate(calls):
        with pytest.raises(BadInput):
            pytest.fail(f"call {number} gives {call()!r}")


def test_a_task_takes_numbers_of_numpy() -> None:

    task = Task.simulate(float(np.float32(0.25)), periods=np.int64(20), initial=np.zeros(2))
    plain = {"frequency_hz": 0.25, "periods": 20, "initial": [0.0, 0.0]}
    assert task.document()["options"] == plain and Task.from_document(task.document()) == task


def test_damaged_files_are_named_and_are_not_finished(tmp_path: Path) -> None:
    from hammerbeam import BadInput

    table = Parameters.grid({"structure.mass.1.mass_kg": [1.0, 2.0]})
    planned = Batch.plan(tmp_path / "batch", STUDIES / "duffing.toml", table)
    item = planned.item(1)
    item.results.mkdir()
    (item.results / "results.db").write_text("")
    item.report.write_text('{"numbers": {')
    assert item.status() is Status.STARTED
    (tmp_path / "batch/batch.json").write_text("{")
    with pytest.raises(BadInput, match=r"batch\.json is damaged"):
        Batch(tmp_path / "batch")
