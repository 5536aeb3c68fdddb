"""Studies of the tests, and one run that many of them look at."""

from pathlib import Path

import hammerbeam
import pytest

ROOT = Path(__file__).resolve().parents[2]
STUDIES = ROOT / "studies"


def changed(name: str, old: str, new: str) -> str:
    """The text of an example study with something replaced."""
    text = (STUDIES / name).read_text(encoding="utf-8")
    assert old in text
    return text.replace(old, new)


@pytest.fixture(scope="session")
def duffing() -> hammerbeam.Study:
    return hammerbeam.Study.read(STUDIES / "duffing.toml")


@pytest.fixture(scope="session")
def folder(duffing: hammerbeam.Study, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The results of the Duffing oscillator."""
    out = tmp_path_factory.mktemp("results") / "duffing"
    duffing.run(out, progress=False, figures=False).close()
    return out


@pytest.fixture
def results(folder: Path) -> hammerbeam.Results:
    return hammerbeam.Results(folder)


@pytest.fixture(scope="session")
def oscillator() -> hammerbeam.Study:
    return hammerbeam.Study.read(STUDIES / "impact-oscillator.toml")
