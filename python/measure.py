"""What Python costs, as the table of docs/performance.md: size and import, a run by the command and by the
package, a million samples and a million solutions into NumPy, many studies.

    python python/measure.py COMMAND [--whole] [--wheel FILE] [--rounds N] [--only PART ...]

* COMMAND: the command `hammerbeam`, built with the same profile as the extension module.
* `--whole`: figure 3 of the paper over its whole range, 19 to 110 Hz, instead of 30 to 38 Hz alone.
* `--wheel`: the wheel whose size is measured; by default the newest in `target/wheels`.
* `--only`: some parts alone, of `size`, `import`, `overhead`, `samples`, `solutions`, `planned` and
  `throughput`.

The package is the one that is installed: install the wheel first. Seconds and sizes of a module that was
built for tests would say nothing.

All seconds but those of the last line are processor time of all threads and processes, the least of some
rounds: other programs may be at work.
"""

import argparse
import os
import resource
import sqlite3
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path

# The folder of this script holds the package as well, beside a module that was built for tests.
sys.path[:] = [path for path in sys.path if Path(path).resolve() != Path(__file__).resolve().parent]

import hammerbeam
import numpy as np
from hammerbeam._native import NativeResults
from hammerbeam._tables import array
from hammerbeam.batch import Batch, Local, Parameters

ROOT = Path(__file__).resolve().parents[1]
EXAMPLE = ROOT / "python/examples/dakota/oscillator.toml"
RUN = "import sys, hammerbeam; hammerbeam.Study.read(sys.argv[1]).run(sys.argv[2], progress=False)"
IMPORT = (
    "from time import process_time as now; a = now(); import numpy; b = now(); import hammerbeam; "
    "print(b - a, now() - b)"
)
Row = tuple[str, str, str]
"""What was measured, what came out, and what is allowed."""


def processor_s(arguments: list[str]) -> float:
    """Processor time of a process and of those that it starts."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(arguments, check=True, capture_output=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime


def size(wheel: Path | None) -> Iterator[Row]:
    """Size of the wheel."""
    built = sorted((ROOT / "target/wheels").glob("*.whl"), key=os.path.getmtime)
    found = wheel or (built[-1] if built else None)
    megabytes = "no wheel: python/test.sh wheel" if found is None else f"{found.stat().st_size / 1e6:.1f} MB"
    yield "wheel", megabytes, "15 MB"


def imported(rounds: int) -> Iterator[Row]:
    """The import in a process of its own: NumPy, and what comes on top."""
    asked = [sys.executable, "-c", IMPORT]
    said = [subprocess.run(asked, capture_output=True, text=True, check=True).stdout for _ in range(rounds)]
    numpy_s, own_s = (min(part) for part in zip(*(map(float, one.split()) for one in said), strict=True))
    yield "import", f"{numpy_s + own_s:.3f} s, of it NumPy {numpy_s:.3f} s", "0.3 s"


def figure_3(whole: bool) -> str:
    """Its study, over the whole range or a part of it."""
    study = hammerbeam.Study.read(ROOT / "studies/beam-with-stop.toml")
    settings = {} if whole else {"excitation.frequency_hz": [30.0, 38.0], "response.period_multiples": [1]}
    return study.text_with(settings)


def overhead(command: str, whole: bool, rounds: int, folder: Path) -> Iterator[Row]:
    """Figure 3 of the paper by the command and by the package, in turn: figures and page among it."""
    path = folder / "figure-3.toml"
    path.write_text(figure_3(whole), encoding="utf-8")
    times = dict[str, list[float]](command=[], python=[])
    for turn in range(rounds):
        out = [str(folder / f"{name}-{turn}") for name in times]
        times["command"].append(processor_s([command, "run", str(path), "--out", out[0]]))
        times["python"].append(processor_s([sys.executable, "-c", RUN, str(path), out[1]]))
    by_command, by_python = (min(found) for found in times.values())
    share = 100 * (by_python / by_command - 1)
    where = "19 to 110 Hz" if whole else "30 to 38 Hz, period 1"
    yield (
        f"paper's figure 3, {where}: the command, the package",
        f"{by_command:.2f} s, {by_python:.2f} s: {by_python - by_command:+.2f} s, {share:+.1f} %",
        "5 % over the whole range",
    )


def samples(rounds: int, folder: Path) -> Iterator[Row]:
    """A motion of a million samples, from its results folder into a structured array."""
    study = hammerbeam.Study.read(ROOT / "studies/duffing.toml")
    study.simulate(0.25, periods=10, samples_per_period=100_000, out=folder / "motion", progress=False)
    read = NativeResults.open(folder / "motion")

    def taken() -> tuple[float, int]:
        start = time.process_time()
        tables = {one[0]: array(one) for one in read.request_tables(1)}
        return time.process_time() - start, len(tables["samples"])

    found = [taken() for _ in range(rounds)]
    rows = found[0][1]
    yield f"{rows:_} samples of a motion".replace("_", " "), f"{min(one[0] for one in found):.3f} s", "0.2 s"


def solutions(rounds: int, folder: Path) -> Iterator[Row]:
    """A folder of a million solutions: opened, and its rows as a structured array."""
    study = hammerbeam.Study.parse(figure_3(whole=False))
    study.run(folder / "diagram", progress=False, figures=False).close()
    enlarge(folder / "diagram/results.db", 1_000_000)

    def taken() -> tuple[float, float, int]:
        start = time.process_time()
        with hammerbeam.Results(folder / "diagram") as results:
            middle = time.process_time()
            rows = len(results.branches())
            return middle - start, time.process_time() - middle, rows

    found = [taken() for _ in range(rounds)]
    open_s, rows_s = (min(one[k] for one in found) for k in (0, 1))
    megabytes = (folder / "diagram/results.db").stat().st_size / 1e6
    opened = f"a folder of {found[0][2]:_} solutions opened".replace("_", " ")
    yield opened, f"{open_s:.2f} s, {megabytes:.0f} MB", ""
    yield "the rows of these solutions", f"{rows_s:.3f} s", "0.2 s"


def enlarge(database: Path, count: int) -> None:
    """Copies the branches of a results folder, under new numbers, until it has so many solutions."""
    with closing(sqlite3.connect(database)) as store, store:
        store.create_function("row_checksum", -1, checksum, deterministic=True)
        [(there, starts, branches)] = store.execute(
            "SELECT (SELECT count(*) FROM solution), max(id) + 1, max(branch) FROM start"
        )
        # A start has two walks, and a walk 2^32 solutions.
        shifts = {
            "start": {"id": starts, "branch": branches},
            "walk": {"id": 2 * starts, "start": starts},
            "solution": {"id": starts << 33},
        }
        for table, shifted in shifts.items():
            columns = store.execute(f"PRAGMA table_info({table})")
            known = [name for _, name, *_ in columns if name != "checksum"]
            copied = [f"{name} + ?1 * {shifted[name]}" if name in shifted else name for name in known]
            rows = f"SELECT {', '.join(copied)} FROM {table} WHERE id < {shifted['id']}"
            for copy in range(1, -(-count // there)):
                store.execute(f"INSERT INTO {table} ({', '.join(known)}) {rows}", (copy,))


def checksum(*values: float | str | bytes | None) -> int:
    """That of crates/results/src/store/checksum.rs."""
    parts = list[bytes]()
    for value in values:
        match value:
            case None:
                parts.append(b"\0")
            case int():
                parts.append(struct.pack("<bq", 1, value))
            case float():
                parts.append(struct.pack("<bd", 2, value + 0.0))
            case _:
                data, tag = (value.encode(), 3) if isinstance(value, str) else (value, 4)
                parts.append(struct.pack("<bQ", tag, len(data)) + data)
    return zlib.crc32(b"".join(parts))


def planned(folder: Path) -> Iterator[Row]:
    """A batch of ten thousand items is planned, and its folder listed."""
    gaps = Parameters.latin_hypercube({"stop.stop.gap_m": (0.8, 1.2)}, 10_000, seed=1)
    start = time.process_time()
    batch = Batch.plan(folder / "large", EXAMPLE, gaps)
    plan_s = time.process_time() - start
    start = time.process_time()
    largest = max(len(files) + len(folders) for _, folders, files in os.walk(batch.folder))
    list_s = time.process_time() - start
    yield "10 000 items planned", f"{plan_s:.2f} s", "5 s"
    yield "their folder listed", f"{list_s:.2f} s, {largest} entries a folder at most", ""


def throughput(folder: Path) -> Iterator[Row]:
    """Two hundred items on two workers, and one after the other in this process."""
    text = hammerbeam.Study.read(EXAMPLE).text_with({"search.frequencies": 12, "search.starts": 6})
    study = hammerbeam.Study.parse(text)
    table = Parameters.latin_hypercube({"stop.stop.gap_m": (0.8, 1.2)}, 200, seed=1)
    alone, by_two = (Batch.plan(folder / name, study, table) for name in ("alone", "by-two"))

    def one_by_one() -> None:
        for number in range(1, len(alone) + 1):
            alone.compute(number)

    one_s, one_cpu = spent(one_by_one)
    two_s, two_cpu = spent(lambda: by_two.run(Local(2), progress=False))
    yield (
        "200 items: one process, two workers",
        f"{one_cpu:.1f} s, {two_cpu:.1f} s: {two_cpu / one_cpu:.3f} of the processor time",
        "1.1 of it",
    )
    share = f"{one_s / two_s / 2:.2f} of two cores"
    yield "the same by the clock", f"{one_s:.1f} s, {two_s:.1f} s: {share}", "0.9 on idle cores"


def spent(work: Callable[[], object]) -> tuple[float, float]:
    """Seconds by the clock, and of processor time, that work takes with the processes that it starts."""

    def cpu() -> float:
        children = resource.getrusage(resource.RUSAGE_CHILDREN)
        return time.process_time() + children.ru_utime + children.ru_stime

    start = time.perf_counter(), cpu()
    work()
    return time.perf_counter() - start[0], cpu() - start[1]


def main() -> None:
    """Prints a line of the table as soon as it is measured."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("command")
    parser.add_argument("--whole", action="store_true")
    parser.add_argument("--wheel", type=Path)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--only", nargs="+")
    given = parser.parse_args()
    print("| what | measured | allowed |\n|---|---|---|")
    with tempfile.TemporaryDirectory() as temporary:
        folder, rounds = Path(temporary), given.rounds
        parts = {
            "size": size(given.wheel),
            "import": imported(rounds),
            "overhead": overhead(given.command, given.whole, rounds, folder),
            "samples": samples(rounds, folder),
            "solutions": solutions(rounds, folder),
            "planned": planned(folder),
            "throughput": throughput(folder),
        }
        for name in given.only or parts:
            for row in parts[name]:
                print(f"| {' | '.join(row)} |", flush=True)
    print(f"\nthe package in {Path(hammerbeam.__file__).parent}")
    print(f"{np.__name__} {np.__version__}, Python {sys.version.split()[0]}, {os.cpu_count()} cores")


if __name__ == "__main__":
    main()
