"""What is shown of work and of results: in a terminal, in a notebook."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT, STUDIES

BEAM = str(STUDIES / "beam-with-stop.toml")
# Long enough for a line of progress, which appears after half a second.
WORK = f"""
import hammerbeam
study = hammerbeam.Study.read({BEAM!r}).with_values({{"excitation.frequency_hz": [30.0, 38.0]}})
"""


@pytest.mark.skipif(os.name != "posix", reason="terminals")
def test_a_terminal_shows_one_line_that_goes_away(tmp_path: Path) -> None:
    import pty

    script = f"{WORK}\nstudy.run({str(tmp_path / 'out')!r}, figures=False)\n"
    ours, its = pty.openpty()
    running = subprocess.Popen([sys.executable, "-c", script], stderr=its)
    os.close(its)
    shown = b""
    try:
        while part := os.read(ours, 4096):
            shown += part
    except OSError:
        pass  # The other end is closed.
    os.close(ours)
    assert running.wait() == 0
    lines = shown.decode().split("\r")
    assert len(lines) > 3 and "\n" not in shown.decode()
    assert all(line.startswith("[") and " Hz, " in line and "%" in line for line in lines[1:-2])
    # The last one is written over with spaces.
    assert lines[-2].strip() == "" and len(lines[-2]) >= len(lines[-3].rstrip()) and lines[-1] == ""
    # Into a file nothing is shown.
    script = f"{WORK}\nstudy.run({str(tmp_path / 'other')!r}, figures=False)\n"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stderr == done.stdout == ""


@pytest.fixture(scope="module")
def cells(tmp_path_factory: pytest.TempPathFactory) -> list[list[dict[str, Any]]]:
    """What the cells of a notebook show."""
    nbformat = pytest.importorskip("nbformat")
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("ipykernel")
    place = tmp_path_factory.mktemp("notebook")
    # Each line of progress replaces the one before, so they are counted beside.
    count = """
import hammerbeam._progress as shown
lines, line = [], shown._line
shown._line = lambda *given: lines.append(line(*given)) or lines[-1]
"""
    texts = [
        WORK + count,
        "results = study.run('out', figures=False)",
        "print(len(lines), lines[0])",
        "results",
        "results.page()",
        "study",
        "study.orbit(36.2).plot();",
        "results.close()\nresults",
    ]
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(text) for text in texts])
    client = nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(place)}})
    with pytest.MonkeyPatch.context() as patch:
        patch.delenv("MPLBACKEND", raising=False)
        patch.setenv("PYTHONPATH", str(ROOT / "python"))
        done = client.execute()
    return [cell["outputs"] for cell in done.cells]


def test_a_notebook_shows_progress_in_one_place_that_is_empty_at_the_end(cells: Any) -> None:
    [shown] = cells[1]
    assert shown["output_type"] == "display_data" and shown["data"]["text/plain"] == ""
    [said] = cells[2]
    number, _, line = said["text"].partition(" ")
    assert int(number) >= 1 and line.startswith("[") and " Hz, " in line


def test_a_notebook_shows_results_as_their_diagram_and_the_page_in_a_frame(cells: Any) -> None:
    [diagram], [page], [study], [closed] = cells[3], cells[4], cells[5], cells[7]
    assert diagram["data"]["image/svg+xml"].count("</svg>") == 1
    assert page["data"]["text/html"].startswith("<iframe srcdoc=")
    assert "Clamped beam with an elastic stop" in study["data"]["text/markdown"]
    assert any("image/png" in output["data"] for output in cells[6])
    assert set(closed["data"]) == {"text/plain"} and "closed" in closed["data"]["text/plain"]
