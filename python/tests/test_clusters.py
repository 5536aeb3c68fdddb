"""Forty small studies on real clusters, with a worker ended in between: the bytes of a run without either.

A package or a command that is not there is skipped, and the test says so.
"""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import hammerbeam
import pytest
from conftest import ROOT
from hammerbeam.batch import Batch, Counts, Dask, Engine, HyperQueue, Parameters

EXAMPLE = ROOT / "python/examples/dakota/oscillator.toml"
ITEMS = 40


def planned(folder: Path) -> Batch:
    gaps = [0.8 + 0.01 * k for k in range(ITEMS // 2)]
    return Batch.plan(
        folder, EXAMPLE, Parameters.grid({"stop.stop.gap_m": gaps, "stop.stop.restitution": [0.6, 0.8]})
    )


def exported(batch: Batch, folder: Path) -> dict[str, bytes]:
    """All tables of all items, states among them, and the table of all of them."""
    files = {"gathered.csv": batch.gather().text().encode()}
    for row, results in batch.results():
        with hammerbeam.Results(results) as read:
            for path in read.export("csv", folder / str(row), states=True):
                files[f"{row}/{path.name}"] = path.read_bytes()
    return files


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> dict[str, bytes]:
    """The same without a cluster: one item after the other, in this process."""
    batch = planned(tmp_path_factory.mktemp("alone") / "batch")
    for number in range(1, len(batch) + 1):
        batch.compute(number)
    files = exported(batch, tmp_path_factory.mktemp("tables"))
    assert len(files) > 4 * ITEMS
    return files


def run_and_kill(batch: Batch, engine: Engine, kill: Callable[[], None]) -> Counts:
    """Runs a batch, and ends something of its engine once a quarter of the items are finished. What was
    finished by then is not computed again."""
    with ThreadPoolExecutor(1) as pool:
        running = pool.submit(batch.run, engine)
        deadline = time.monotonic() + 120
        while batch.counts().finished < ITEMS // 4:
            assert time.monotonic() < deadline and not running.done(), batch.counts()
            time.sleep(0.05)
        before = products(batch)
        assert len(before) < ITEMS
        kill()
        counts = running.result(timeout=240)
    assert before == {number: products(batch)[number] for number in before}
    return counts


def test_dask_with_a_worker_ended_in_between(tmp_path: Path, alone: dict[str, bytes]) -> None:
    distributed = pytest.importorskip("distributed", reason="the package distributed is not there")
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, host="127.0.0.1"
    )
    batch = planned(tmp_path / "batch")
    with cluster, distributed.Client(cluster) as client:

        def kill() -> None:
            workers = client.run(os.getpid)
            assert len(workers) == 2
            os.kill(next(iter(workers.values())), signal.SIGKILL)

        assert run_and_kill(batch, Dask(client), kill).finished == ITEMS
    assert exported(batch, tmp_path / "tables") == alone


def computing(folder: Path) -> list[Any]:
    """Processes that compute items of a batch just now."""
    psutil = pytest.importorskip("psutil")
    found = []
    for process in psutil.process_iter(["cmdline"]):
        words = process.info["cmdline"] or []
        if str(folder) in words and "item" in words:
            found.append(process)
    return found


def kill_one(folder: Path) -> None:
    """Ends one process that computes an item."""
    for _ in range(2000):
        for process in computing(folder):
            process.kill()
            return
        time.sleep(0.005)
    raise AssertionError("no process computes an item")


# The workers of HyperQueue's LocalCluster are threads of the process that starts it: one of its own.
LOCAL_CLUSTER = """
import sys
from hyperqueue.cluster import LocalCluster, WorkerConfig
with LocalCluster(sys.argv[1], WorkerConfig(cores=1)) as cluster:
    cluster.start_worker(WorkerConfig(cores=1))
    print("ready", flush=True)
    sys.stdin.read()
"""


def local_cluster(folder: Path) -> "subprocess.Popen[str]":
    pytest.importorskip("hyperqueue", reason="the package hyperqueue is not there")
    folder.mkdir()
    command = [sys.executable, "-c", LOCAL_CLUSTER, str(folder)]
    cluster = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    assert cluster.stdout is not None
    # The server shows a table of itself first.
    assert "ready\n" in iter(cluster.stdout.readline, "")
    return cluster


def test_hyperqueue_with_a_process_and_the_whole_cluster_ended(
    tmp_path: Path, alone: dict[str, bytes]
) -> None:
    hyperqueue = pytest.importorskip("hyperqueue", reason="the package hyperqueue is not there")
    batch = planned(tmp_path / "batch")
    first = local_cluster(tmp_path / "first")
    client = hyperqueue.Client(tmp_path / "first")
    # The package keeps the interpreter to itself while it waits, so another process does it.
    command = [sys.executable, __file__, str(batch.folder), str(first.pid)]
    ending = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    try:
        # Whatever the package says of a server that is gone.
        with pytest.raises(Exception):  # noqa: B017, PT011
            batch.run(HyperQueue(client=client))
    finally:
        ending.wait()
        first.kill()
        first.wait()
    assert ending.stdout is not None and ending.returncode == 0
    before = json.loads(ending.stdout.read())
    assert ITEMS // 2 <= len(before) < ITEMS
    second = local_cluster(tmp_path / "second")
    try:
        assert batch.run(HyperQueue(client=hyperqueue.Client(tmp_path / "second"))).finished == ITEMS
    finally:
        second.communicate(timeout=20)
    assert before == {number: products(batch)[number] for number in before}
    assert exported(batch, tmp_path / "tables") == alone


def products(batch: Batch) -> dict[str, list[int]]:
    """What identifies the reports that are there: none of them is written twice."""
    reports = {str(number): batch.item(number).report for number in range(1, ITEMS + 1)}
    found = {number: report.stat() for number, report in reports.items() if report.is_file()}
    return {number: [report.st_ino, report.st_mtime_ns] for number, report in found.items()}


def end_both(folder: Path, cluster: int) -> None:
    """Ends a process that computes an item, later the cluster, and says what was finished by then."""
    batch = Batch(folder)
    while batch.counts().finished < ITEMS // 4:
        time.sleep(0.05)
    kill_one(folder)
    while batch.counts().finished < ITEMS // 2:
        time.sleep(0.05)
    print(json.dumps(products(batch)))
    os.kill(cluster, signal.SIGKILL)


@pytest.fixture
def hq(tmp_path: Path) -> Iterator[tuple[str, Path, list["subprocess.Popen[bytes]"]]]:
    """A server of the command `hq` and its two workers."""
    command = shutil.which("hq")
    if command is None:
        pytest.skip("the command hq is not there (the package hyperqueue has only its Python interface)")
    folder = tmp_path / "server"
    base = [command, f"--server-dir={folder}"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    server = [*base, "server", "start", "--host=127.0.0.1"]
    started = [subprocess.Popen(server, **quiet)]  # type: ignore[call-overload]
    for _ in range(200):
        if subprocess.run([*base, "server", "info"], capture_output=True).returncode == 0:
            break
        time.sleep(0.05)
    worker = [*base, "worker", "start", "--cpus=1"]
    started += [subprocess.Popen(worker, **quiet) for _ in range(2)]  # type: ignore[call-overload]
    yield command, folder, started
    for process in reversed(started):
        process.terminate()
        process.wait()


def test_the_command_of_hyperqueue_with_a_worker_ended(
    tmp_path: Path, alone: dict[str, bytes], hq: tuple[str, Path, list["subprocess.Popen[bytes]"]]
) -> None:
    _, server, (_, one, _) = hq
    batch = planned(tmp_path / "batch")
    assert run_and_kill(batch, HyperQueue(server), one.kill).finished == ITEMS
    assert exported(batch, tmp_path / "tables") == alone


if __name__ == "__main__":
    end_both(Path(sys.argv[1]), int(sys.argv[2]))
