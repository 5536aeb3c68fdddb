"""The snippets of the documentation run, in their order."""

import json
import re
import shutil
import subprocess
import sys
import warnings
from pathlib import Path

import hammerbeam
import pytest
from conftest import ROOT
from hammerbeam.batch import Batch, Parameters

PAGE = ROOT / "docs/tutorials/python.md"
MANY = ROOT / "docs/how-to/many-studies.md"
CLUSTER = ROOT / "docs/how-to/run-on-a-cluster.md"
# Pages with studies, whole and in part. The data file of `fit-to-measurements.md` is no study.
STUDIED = [
    ROOT / "docs/reference/study-file.md",
    *(page for page in sorted(MANY.parent.glob("*.md")) if page.name != "fit-to-measurements.md"),
]
README = ROOT / "README.md"


def snippets(language: str, page: Path = PAGE) -> list[str]:
    return re.findall(rf"^```{language}\n(.*?)^```$", page.read_text(encoding="utf-8"), re.M | re.S)


@pytest.fixture(scope="module")
def place(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder in which the snippets have run."""
    matplotlib = pytest.importorskip("matplotlib")
    pytest.importorskip("pandas")
    matplotlib.use("agg")
    folder = tmp_path_factory.mktemp("tutorial")
    (folder / "studies").symlink_to(ROOT / "studies")
    return folder


def test_the_tutorial_runs(
    place: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(place)
    names: dict[str, object] = {}
    found = snippets("python")
    assert len(found) >= 6
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for number, snippet in enumerate(found):
            exec(compile(snippet, f"{PAGE.name}, snippet {number + 1}", "exec"), names)
    out = capsys.readouterr().out
    assert "fold" in out and "<Orbit 0.25 Hz" in out
    assert (place / "export/results.json").is_file()


def test_the_block_of_the_readme_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("matplotlib").use("agg")
    (tmp_path / "studies").symlink_to(ROOT / "studies")
    monkeypatch.chdir(tmp_path)
    [snippet] = snippets("python", README)
    names: dict[str, object] = {"hammerbeam": hammerbeam}
    exec(compile(snippet, README.name, "exec"), names)
    results = names["results"]
    assert isinstance(results, hammerbeam.Results) and len(results.branches()) > 1000


def test_each_diagram_from_files_takes_six_lines() -> None:
    python = next(snippet for snippet in snippets("python") if "results.npz" in snippet)
    [matlab] = snippets("matlab")
    for text in (python, matlab):
        assert len([line for line in text.splitlines() if line]) <= 6


def test_octave_draws_the_diagram(place: Path) -> None:
    octave = shutil.which("octave-cli") or shutil.which("octave")
    if octave is None:
        pytest.skip("Octave is not there (on Debian: apt-get install octave)")
    if not (place / "export/results.json").is_file():
        pytest.skip("the tutorial has not run")
    [snippet] = snippets("matlab")
    # What is drawn is printed: a machine without a screen may have no toolkit to draw with.
    for name in ("plot", "hold", "xlabel", "ylabel"):
        body = "printf('%d ', numel(varargin{2}));" if name == "plot" else ""
        (place / f"{name}.m").write_text(f"function {name}(varargin)\n  {body}\nend\n")
    script = place / "diagram.m"
    script.write_text(snippet)
    rows = json.loads((place / "export/results.json").read_text())["branches"]["branch"]
    done = subprocess.run(
        [octave, "--no-gui", "--quiet", script.name], cwd=place, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert [int(count) for count in done.stdout.split()] == [
        rows.count(number) for number in sorted(set(rows))
    ]


def test_many_studies_are_run_as_the_page_says(place: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(place)
    names: dict[str, object] = {}
    for number, snippet in enumerate(snippets("python", MANY)):
        exec(compile(snippet, f"{MANY.name}, snippet {number + 1}", "exec"), names)
    rows = (place / "results/forces/gathered.csv").read_text().splitlines()
    assert len(rows) == 5 and all(",finished," in row for row in rows[1:])
    assert list((place / "results/basins/merged").glob("*/*/results/basins.csv"))


def test_many_studies_run_from_a_terminal_as_the_page_says(tmp_path: Path) -> None:
    (tmp_path / "studies").symlink_to(ROOT / "studies")
    (tmp_path / "forces.csv").write_text("excitation.amplitude_n\n0.2\n0.3\n")
    commands = [line.split() for line in snippets("sh", MANY)[0].splitlines()]
    assert [words[:3] for words in commands] == [["python", "-m", "hammerbeam.batch"]] * 4
    for words in commands:
        done = subprocess.run([sys.executable, *words[1:]], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
    rows = (tmp_path / "results/forces/gathered.csv").read_text().splitlines()
    assert len(rows) == 3 and all(",finished," in row for row in rows[1:])
    (tmp_path / "task.json").write_text(snippets("json", MANY)[0])
    for line, counts in zip(snippets("sh", MANY)[1].splitlines(), ("0 of 6", "0 of 40"), strict=True):
        words = [sys.executable, *line.split()[1:]]
        done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True)
        assert done.stdout.startswith(counts), done.stderr


def test_a_job_array_is_written_as_the_page_of_clusters_says(tmp_path: Path) -> None:
    study = ROOT / "python/examples/dakota/oscillator.toml"
    Batch.plan(tmp_path / "results/forces", study, Parameters.grid({"excitation.amplitude_n": [0.2, 0.3]}))
    [words] = [line.split() for block in snippets("sh", CLUSTER) for line in block.splitlines()]
    assert words[:3] == ["python", "-m", "hammerbeam.batch"]
    done = subprocess.run([sys.executable, *words[1:]], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert "#SBATCH --time=01:00:00\n" in (tmp_path / "results/forces/slurm.sh").read_text()


def test_examples_of_studies_have_keys_that_there_are() -> None:
    """What a part of a study lacks is reported, and so is a key that no reader knows."""
    whole, in_part = 0, 0
    for page in STUDIED:
        for snippet in snippets("toml", page):
            try:
                hammerbeam.Study.parse(snippet)
                whole += 1
            except hammerbeam.StudyError as error:
                in_part += 1
                unknown = [one["message"] for one in error.problems if "unknown key" in one["message"]]
                assert error.problems and not unknown, f"{page.name}: {unknown}"
    assert whole >= 6 and in_part >= 20
    with pytest.raises(hammerbeam.StudyError, match="unknown key"):
        hammerbeam.Study.parse("[damping]\nmodal_ratios = 0.02\n")
