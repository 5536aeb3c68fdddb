"""`python -m hammerbeam.batch`: a batch folder from a terminal, and what engines call.

    python -m hammerbeam.batch plan FOLDER STUDY TABLE.csv [--task TASK.json]
    python -m hammerbeam.batch plan FOLDER STUDY --grid KEY=VALUE,VALUE,... ...
    python -m hammerbeam.batch plan FOLDER STUDY --latin KEY=LOW:HIGH ... --samples N [--seed S]
    python -m hammerbeam.batch run FOLDER [--processes N] [--hyperqueue]
    python -m hammerbeam.batch status FOLDER
    python -m hammerbeam.batch gather FOLDER
    python -m hammerbeam.batch slurm FOLDER [OPTION ...]
    python -m hammerbeam.batch item [--jobs N] FOLDER WHICH ...

WHICH is a number, a range such as 101-200, `--entry` for the entry of HyperQueue, or `-` for numbers from
standard input. TASK.json says what is computed instead of a run, such as
`{"method": "sweep", "options": {"starts": 20}, "parts": 4}`. Exit codes are those of the command
`hammerbeam`.
"""

import argparse
import json
import os
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TypeVar

from .. import _check
from .._errors import BadInput, HammerbeamError
from ._batch import Batch
from ._folder import Status, read_json
from ._hyperqueue import HyperQueue
from ._local import Local
from ._parameters import Parameters
from ._slurm import slurm_script
from ._task import Task
from ._watch import Lines

Given = TypeVar("Given")


def main(arguments: Sequence[str] | None = None) -> int:
    """Does what was asked for: the exit code."""
    given, rest = _parser().parse_known_args(arguments)
    try:
        if given.command == "item":
            return _items(Batch(given.folder), rest, given.jobs)
        code: int = given.does(given, rest)
        return code
    except HammerbeamError as error:
        print(f"error: {error}", file=sys.stderr)
        return error.exit_code
    except OSError as error:
        place = f"{error.filename}: " if error.filename else ""
        print(f"error: {place}{error.strerror or error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt as error:
        print(str(error) or "interrupted; what was computed is kept", file=sys.stderr)
        return 130


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="python -m hammerbeam.batch", description=__doc__.splitlines()[0])
    commands = parser.add_subparsers(dest="command", required=True)
    for name, does in (
        ("plan", _plan),
        ("run", _run),
        ("status", _status),
        ("gather", _gather),
        ("slurm", _slurm),
    ):
        commands.add_parser(name).set_defaults(does=does)
        commands.choices[name].add_argument("folder")
    plan = commands.choices["plan"]
    plan.add_argument("study")
    plan.add_argument("table", nargs="?")
    plan.add_argument("--grid", action="append", default=[], metavar="KEY=VALUE,VALUE,...")
    plan.add_argument("--latin", action="append", default=[], metavar="KEY=LOW:HIGH")
    plan.add_argument("--samples", type=int)
    plan.add_argument("--seed", type=int)
    plan.add_argument("--task", metavar="TASK.json")
    commands.choices["run"].add_argument("--processes", type=int)
    commands.choices["run"].add_argument("--hyperqueue", action="store_true")
    item = commands.add_parser("item")
    item.add_argument("--jobs", type=int, default=1)
    item.add_argument("folder")
    return parser


def _none(rest: Sequence[str]) -> None:
    if rest:
        raise BadInput(f"{rest[0]!r} is not expected here")


def _plan(given: argparse.Namespace, rest: Sequence[str]) -> int:
    _none(rest)
    task = None if given.task is None else Task.from_document(read_json(Path(given.task)))
    print(Batch.plan(given.folder, given.study, _table(given), task).counts())
    return 0


def _table(given: argparse.Namespace) -> Parameters:
    """The table that is read, made of all combinations of values, or drawn from ranges."""
    samples = (given.samples, given.seed)
    ways = [given.table is not None, bool(given.grid), bool(given.latin) or samples != (None, None)]
    if sum(ways) > 1:
        raise BadInput("one of a table, --grid, and --latin with --samples says which studies are meant")
    if given.table is not None:
        return Parameters.read(given.table)
    if given.grid:
        return Parameters.grid(_by_key("--grid", [_values(text) for text in given.grid]))
    if not given.latin or given.samples is None:
        ways_in_words = "a table, --grid KEY=VALUE,VALUE,..., or --latin KEY=LOW:HIGH with --samples N"
        raise BadInput(f"which studies are meant is missing: {ways_in_words}")
    ranges = _by_key("--latin", [_range(text) for text in given.latin])
    return Parameters.latin_hypercube(ranges, given.samples, 0 if given.seed is None else given.seed)


def _by_key(option: str, pairs: Sequence[tuple[str, Given]]) -> dict[str, Given]:
    by_key = dict(pairs)
    if len(by_key) < len(pairs):
        raise BadInput(f"{option}: the same key is given twice")
    return by_key


def _values(text: str) -> tuple[str, list[str]]:
    """A key with its values, as they are written."""
    key, _, words = text.partition("=")
    values = [word.strip() for word in words.split(",")]
    if not key or not all(values):
        must = "must be KEY=VALUE,VALUE,..., as in stop.1.gap_m=1e-3,2e-3"
        raise BadInput(f"--grid: found {text!r}, {must}")
    return key, values


def _range(text: str) -> tuple[str, tuple[float, float]]:
    """A key with the ends of its range."""
    key, _, ends = text.partition("=")
    low, _, high = ends.partition(":")
    try:
        return key, (float(low), float(high))
    except ValueError:
        must = "must be KEY=LOW:HIGH, as in stop.1.gap_m=1e-3:2e-3"
        raise BadInput(f"--latin: found {text!r}, {must}") from None


def _run(given: argparse.Namespace, rest: Sequence[str]) -> int:
    _none(rest)
    batch = Batch(given.folder)
    engine = HyperQueue() if given.hyperqueue else Local(given.processes)
    counts = batch.run(engine, progress=True if sys.stderr.isatty() else Lines())
    print(counts)
    return 0 if counts.finished == counts.items else 1


def _status(given: argparse.Namespace, rest: Sequence[str]) -> int:
    _none(rest)
    batch = Batch(given.folder)
    print(batch.counts())
    for number, message in batch.failures().items():
        print(f"  item {number}: {message}")
    return 0


def _gather(given: argparse.Namespace, rest: Sequence[str]) -> int:
    _none(rest)
    for path in Batch(given.folder).gather().write():
        print(path)
    return 0


def _slurm(given: argparse.Namespace, rest: Sequence[str]) -> int:
    print(slurm_script(Batch(given.folder), options=rest))
    return 0


def _items(batch: Batch, which: Sequence[str], jobs: int) -> int:
    """Computes items: 0 if all are finished, else the exit code of the last one that failed."""
    jobs = _check.whole("--jobs", jobs, 1, _check.MOST_JOBS)
    code = 0
    for number in _numbers(which, len(batch)):
        status = batch.compute(number, jobs)
        if list(which) == ["-"]:
            print(status.value, flush=True)
        if status is Status.FAILED:
            failure = read_json(batch.item(number).failure)
            print(f"item {number}: {failure['message']}", file=sys.stderr)
            code = int(failure["exit_code"])
        elif status is not Status.FINISHED:
            code = 1
    return code


def _numbers(which: Sequence[str], count: int) -> Iterator[int]:
    if not which:
        raise BadInput("which items are meant is missing")
    for word in which:
        low, _, high = word.partition("-")
        if word == "-":
            yield from (_number(line.strip()) for line in sys.stdin)
        elif word == "--entry":
            yield _number(str(json.loads(os.environ.get("HQ_ENTRY", "{}")).get("item", "")))
        elif low.isdecimal() and high.isdecimal():
            # The last task of an array may reach beyond the last item.
            yield from range(int(low), min(int(high), count) + 1)
        else:
            yield _number(word)


def _number(text: str) -> int:
    if not text.isdecimal():
        raise BadInput(f"found the item {text!r}, must be a number, or a range such as 101-200")
    return int(text)


if __name__ == "__main__":
    sys.exit(main())
