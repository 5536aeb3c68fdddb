"""What Python costs: a run by the command and by the package, in turn; a million rows into NumPy; the
import; many studies.

    python python/measure.py COMMAND [STUDY]

COMMAND and the extension module have to be built with the same profile.
"""

import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import hammerbeam
import numpy as np
from hammerbeam._native import NativeResults
from hammerbeam._tables import array
from hammerbeam.batch import Batch, Local, Parameters

ROUNDS = 5
SCRIPT = "import sys, hammerbeam; hammerbeam.Study.read(sys.argv[1]).run(sys.argv[2], progress=False)"


def seconds(arguments: list[str]) -> float:
    """How long a process takes."""
    started = time.perf_counter()
    subprocess.run(arguments, check=True, capture_output=True)
    return time.perf_counter() - started


def overhead(command: str, study: str, folder: Path) -> None:
    """The same run by both, in turn; the fastest of each counts on a busy machine."""
    pairs = []
    for turn in range(ROUNDS):
        out = [str(folder / f"{name}-{turn}") for name in ("command", "python")]
        by_command = seconds([command, "run", study, "--out", out[0]])
        by_python = seconds([sys.executable, "-c", SCRIPT, study, out[1]])
        pairs.append((by_command, by_python))
        print(f"run: command {by_command:.2f} s, Python {by_python:.2f} s")
    least = [min(times) for times in zip(*pairs, strict=True)]
    print(f"run: least {least[0]:.2f} s and {least[1]:.2f} s, ratio {least[1] / least[0]:.3f}")


def million(folder: Path) -> None:
    """A motion of a million samples, from its results folder into a structured array."""
    study = hammerbeam.Study.read(Path(__file__).parents[1] / "studies/duffing.toml")
    study.simulate(0.25, periods=10, samples_per_period=100_000, out=folder / "motion", progress=False)
    read = NativeResults.open(folder / "motion")
    # Processor time: other programs may be at work.
    started = time.process_time()
    packed = read.request_tables(1)
    middle = time.process_time()
    tables = {one[0]: array(one) for one in packed}
    ended = time.process_time()
    rows = tables["samples"]
    print(
        f"{len(rows)} rows of {len(rows.dtype)} columns: read and packed {middle - started:.3f} s,", end=" "
    )
    print(f"into NumPy {1e3 * (ended - middle):.3f} ms; largest {np.abs(rows['displacement_m']).max():.6f} m")


def imported() -> None:
    """The import in a process of its own, with NumPy and beside it."""
    for clock in ("perf_counter", "process_time"):
        script = (
            f"from time import {clock} as now; a = now(); import numpy; b = now(); import hammerbeam; "
            "print(b - a, now() - b)"
        )
        asked = [sys.executable, "-c", script]
        found = [subprocess.run(asked, capture_output=True, text=True) for _ in range(5)]
        times = [[float(word) for word in one.stdout.split()] for one in found]
        numpy_s, own_s = (min(part) for part in zip(*times, strict=True))
        print(f"import, {clock}: NumPy {numpy_s:.3f} s, hammerbeam beside it {own_s:.3f} s")


def many(folder: Path) -> None:
    """A batch of ten thousand items is planned; two hundred items on two workers and in this process
    alone."""
    study = hammerbeam.Study.read(Path(__file__).parent / "examples/dakota/oscillator.toml")
    gaps = {"stop.stop.gap_m": (0.8, 1.2)}
    started = time.perf_counter(), time.process_time()
    Batch.plan(folder / "large", study, Parameters.latin_hypercube(gaps, 10_000, seed=1))
    taken = time.perf_counter() - started[0], time.process_time() - started[1]
    print(f"10000 items planned: {taken[0]:.2f} s, of them {taken[1]:.2f} s of processor time")

    study = hammerbeam.Study.parse(study.text_with({"search.frequencies": 12, "search.starts": 6}))
    table = Parameters.latin_hypercube(gaps, 200, seed=1)
    alone, by_two = (Batch.plan(folder / name, study, table) for name in ("alone", "by-two"))
    started = time.perf_counter(), time.process_time()
    for number in range(1, 201):
        alone.compute(number)
    one_s, one_cpu = time.perf_counter() - started[0], time.process_time() - started[1]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    started = time.perf_counter(), time.process_time()
    by_two.run(Local(2))
    two_s, own_cpu = time.perf_counter() - started[0], time.process_time() - started[1]
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    two_cpu = own_cpu + after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    print(f"200 items: alone {one_s:.1f} s ({one_cpu:.1f} s of processor time),", end=" ")
    print(
        f"two workers {two_s:.1f} s ({two_cpu:.1f} s): {two_cpu / one_cpu:.3f} of the processor time,",
        end=" ",
    )
    print(f"{one_s / two_s:.2f} times as quick")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    given = sys.argv[2] if len(sys.argv) > 2 else str(Path(__file__).parents[1] / "studies/duffing.toml")
    with tempfile.TemporaryDirectory() as temporary:
        imported()
        million(Path(temporary))
        many(Path(temporary))
        overhead(sys.argv[1], given, Path(temporary))
