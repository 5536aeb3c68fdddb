"""Ctrl-C while HyperQueue computes: what is left is cancelled.

A package or a command that is not there is skipped, and the test says so; a stand-in for the command always runs.
"""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from hammerbeam.batch import Batch
from test_clusters import ITEMS, computing, hq, local_cluster, planned

__all__ = ["hq"]


STAND_IN = """\
#!/bin/sh
# Takes a job, and keeps whoever waits for it waiting.
echo "$@" >> {log}
case "$*" in
    *" submit "*) sleep 0.5; echo 7 ;;
    *" job wait "*) exec sleep 60 ;;
esac
"""


@pytest.mark.parametrize("last", ["submit", "job wait"])
def test_ctrl_c_cancels_the_job_of_hyperqueue(tmp_path: Path, last: str) -> None:
    log = tmp_path / "log"
    (tmp_path / "bin").mkdir()
    command = tmp_path / "bin/hq"
    command.write_text(STAND_IN.format(log=log))
    command.chmod(0o755)
    batch = planned(tmp_path / "batch")
    running = interruptible(batch, "HyperQueue()", str(command.parent))
    wait_until(lambda: log.is_file() and f" {last} " in log.read_text())
    assert interrupted(running) == 130
    asked = [line.partition("--output-mode=quiet ")[2].partition(" --")[0] for line in log.open()]
    expected = ["submit", "job wait 7\n", "job cancel 7\n"]
    assert asked == [one for one in expected if last != "submit" or "wait" not in one]


def test_the_command_of_hyperqueue_cancels_what_is_left(
    tmp_path: Path, hq: tuple[str, Path, list["subprocess.Popen[bytes]"]]
) -> None:
    command, server, _ = hq
    batch = planned(tmp_path / "batch")
    running = interruptible(batch, f"HyperQueue({str(server)!r})", str(Path(command).parent))
    wait_until(lambda: batch.counts().finished >= 4)
    assert interrupted(running) == 130
    listed = [command, f"--server-dir={server}", "--output-mode=quiet", "job", "list", "--all"]
    states = subprocess.run(listed, capture_output=True, text=True, check=True).stdout
    assert states.split()[-1] == "CANCELED"
    wait_until(lambda: not computing(batch.folder))
    nothing_more_is_computed(batch)


def test_the_package_of_hyperqueue_starts_nothing_more(tmp_path: Path) -> None:
    batch, cluster = planned(tmp_path / "batch"), local_cluster(tmp_path / "server")
    try:
        server = str(tmp_path / "server")
        engine = f"HyperQueue(client=__import__('hyperqueue').Client({server!r}))"
        running = interruptible(batch, engine, os.defpath)
        wait_until(lambda: batch.counts().finished >= 4)
        assert interrupted(running) == 130
        wait_until(lambda: not computing(batch.folder))
        nothing_more_is_computed(batch)
    finally:
        cluster.communicate(timeout=20)


def interruptible(batch: Batch, engine: str, path: str) -> "subprocess.Popen[str]":
    """Runs a batch in a process of its own, in a group of its own as from a terminal."""
    script = f"""
import signal, sys
from hammerbeam import Interrupted
from hammerbeam.batch import Batch, HyperQueue
# A shell that starts the tests in the background lets its children ignore Ctrl-C.
signal.signal(signal.SIGINT, signal.default_int_handler)
try:
    Batch({str(batch.folder)!r}).run({engine}, progress=False)
except Interrupted as error:
    sys.exit(error.exit_code)
"""
    environment = {**os.environ, "PATH": f"{path}{os.pathsep}{os.environ['PATH']}"}
    asked = [sys.executable, "-c", script]
    return subprocess.Popen(asked, env=environment, stdout=subprocess.PIPE, text=True, start_new_session=True)


def interrupted(running: "subprocess.Popen[str]") -> int:
    """Ctrl-C, as a terminal sends it to all processes of the group: the exit code."""
    os.killpg(running.pid, signal.SIGINT)
    running.communicate(timeout=60)
    return running.returncode


def wait_until(is_so: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 120
    while not is_so():
        assert time.monotonic() < deadline
        time.sleep(0.05)


def nothing_more_is_computed(batch: Batch) -> None:
    finished = batch.counts().finished
    assert 4 <= finished < ITEMS
    time.sleep(1.5)
    assert batch.counts().finished == finished and not computing(batch.folder)
