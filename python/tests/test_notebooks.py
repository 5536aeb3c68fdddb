"""The notebooks run, with what they assert."""

import shutil
from pathlib import Path

import pytest
from conftest import ROOT

nbformat = pytest.importorskip("nbformat")
nbclient = pytest.importorskip("nbclient")
pytest.importorskip("ipykernel")

NOTEBOOKS = sorted((ROOT / "python/notebooks").glob("*.ipynb"))


def test_there_are_three() -> None:
    assert len(NOTEBOOKS) == 3


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_and_is_stored_without_output(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # Figures are shown in the notebook.
    monkeypatch.delenv("MPLBACKEND", raising=False)
    notebook = nbformat.read(path, as_version=4)
    assert all(not cell.get("outputs") and cell.get("execution_count") is None for cell in notebook.cells)
    # A folder of its own below the project, whose studies a notebook finds from there. Results of an earlier
    # run would be taken as they are.
    place = ROOT / "target/notebooks" / path.stem
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    client = nbclient.NotebookClient(notebook, timeout=300, resources={"metadata": {"path": str(place)}})
    done = client.execute()
    shown = [output for cell in done.cells for output in cell.get("outputs", [])]
    assert any(output["output_type"] in ("display_data", "execute_result") for output in shown)
