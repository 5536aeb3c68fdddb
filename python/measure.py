"""What Python costs: a run by the command and by the package, in turn; a million rows into NumPy; the import.

    python python/measure.py COMMAND [STUDY]

COMMAND and the extension module have to be built with the same profile.
"""

import subprocess
import sys
import tempfile
import time
from pathlib import Path

import hammerbeam
import numpy as np
from hammerbeam._native import NativeResults
from hammerbeam._tables import array

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
    script = (
        "import time; a = time.perf_counter(); import numpy; b = time.perf_counter(); import hammerbeam; "
    )
    script += "print(b - a, time.perf_counter() - b)"
    found = [subprocess.run([sys.executable, "-c", script], capture_output=True, text=True) for _ in range(5)]
    times = [[float(word) for word in one.stdout.split()] for one in found]
    numpy_s, own_s = (min(part) for part in zip(*times, strict=True))
    print(f"import: NumPy {numpy_s:.3f} s, hammerbeam beside it {own_s:.3f} s")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    given = sys.argv[2] if len(sys.argv) > 2 else str(Path(__file__).parents[1] / "studies/duffing.toml")
    with tempfile.TemporaryDirectory() as temporary:
        imported()
        million(Path(temporary))
        overhead(sys.argv[1], given, Path(temporary))
