"""Errors carry what their messages say as values, and go to another process with them."""

import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import hammerbeam
import numpy as np
import pytest
from hammerbeam import BadInput, HammerbeamError, Results, Study


def raised_by(call: Callable[[], Any]) -> HammerbeamError:
    """What a call raises; it goes to another process and comes back with its numbers."""
    with pytest.raises(HammerbeamError) as raised:
        call()
    again = pickle.loads(pickle.dumps(raised.value))
    assert again.numbers == raised.value.numbers and again.name == raised.value.name
    return raised.value


def test_numbers_of_what_is_refused_in_python(duffing: Study, results: Results) -> None:
    def found(call: Callable[[], Any]) -> Any:
        error = raised_by(call)
        assert isinstance(error, BadInput) and error.name == "BadInput"
        return error.numbers

    bad: list[Any] = ["fast", 1.5, np.int32(65), 1]
    both: Any = ["q1", "v1"]
    assert found(lambda: duffing.orbits(bad[0])) == {"found": "fast", "low": 1e-10, "high": 1e10}
    assert found(lambda: duffing.orbits(0.25, bad[1])) == {"found": 1.5, "low": 1, "high": 64}
    assert found(lambda: duffing.orbits(0.25, bad[2])) == {"found": 65, "low": 1, "high": 64}
    assert found(lambda: duffing.run("out", figures=bad[3])) == {"found": 1}
    assert found(lambda: duffing.basins(0.25, ("q1", 1.0, -1.0), both)) == {"found": [1.0, -1.0]}
    assert found(lambda: duffing.simulate(0.25, initial=np.zeros((2, 2)))) == {"shape": [2, 2]}
    assert found(lambda: Study.from_matrices(np.eye(3), np.ones((3, 2)), points={})) == {"shape": [3, 2]}
    assert found(lambda: results.export("xls"))["allowed"][:2] == ["csv", "json"]
    assert found(lambda: results.plot("bang"))["found"] == "bang"
    assert found(lambda: results.orbits(event="bang"))["found"] == "bang"
    assert "fold" in found(lambda: results.orbits(event="bang"))["allowed"]
    assert found(lambda: results.draw("drawn", formats="gif"))["allowed"] == ["svg", "png", "pdf"]
    assert found(lambda: results.draw("drawn", resolution=1.0)) == {"found": 1.0, "low": 24.0, "high": 1200.0}


def test_numbers_of_what_is_refused_in_rust(duffing: Study, tmp_path: Path) -> None:
    def found(call: Callable[[], Any]) -> tuple[type[HammerbeamError], str, Any]:
        error = raised_by(call)
        return type(error), error.name, error.numbers

    out, both = tmp_path / "out", ("v1", -1.0, 1.0)
    length = found(lambda: duffing.simulate(0.25, initial=[1.0, 2.0, 3.0]))
    assert length == (hammerbeam.InitialStateError, "Length", {"found": 3, "expected": 2})
    words = found(lambda: duffing.simulate(0.25, initial="what"))[2]
    assert words == {"found": "what", "expected": 2}
    _, name, numbers = found(lambda: duffing.simulate(0.25, initial={"tip.y": 1.0}))
    assert (name, numbers["point"], numbers["known"][0]) == ("UnknownPoint", "tip", "mass")
    axis = found(lambda: duffing.basins(0.25, ("q7", -1.0, 1.0), both))
    assert axis == (hammerbeam.CoordinateError, "Unknown", {"name": "q7", "modes": 1})
    same = found(lambda: duffing.basins(0.25, both, both))
    assert same[1:] == ("Same", {"x": "v1", "y": "v1"})
    kind, name, numbers = found(
        lambda: duffing.simulate(0.25, periods=100_000_000, samples_per_period=1000, out=out)
    )
    assert (kind, name) == (hammerbeam.SimulationTooLarge, "Periods")
    assert numbers["periods"] * numbers["of_period"] == numbers["numbers"] > numbers["most"]
    assert numbers["most_periods"] == numbers["most"] // numbers["of_period"]
    _, name, numbers = found(lambda: duffing.simulate(0.25, duration_s=1e15))
    # Periods of 4 s.
    assert numbers["found"] == 0.25e15 > numbers["most"]
    _, name, numbers = found(lambda: duffing.text_with({"structure.mass.7.mass_kg": 1.0}))
    assert (name, numbers["name"], numbers["path"]) == ("NoSuchElement", "7", "structure.mass")
    folder = found(lambda: Results(tmp_path))
    assert folder == (hammerbeam.StoreError, "NoResults", {"folder": str(tmp_path)})
    study = found(lambda: Study.read(tmp_path / "none.toml"))
    assert study[1:] == ("Unreadable", {"path": str(tmp_path / "none.toml")})
    assert found(lambda: duffing.simulate(0.25, initial="branch:1"))[1] == "NoResults"


def test_an_option_that_a_method_does_not_have(duffing: Study, tmp_path: Path) -> None:
    axis: Any = ("q1", -1.0, 1.0)
    bogus: dict[str, Any] = {"bogus": 1}
    with pytest.raises(TypeError, match=r"basins_part\(\) got an unexpected keyword argument 'bogus'"):
        duffing.basins_part((1, 2), tmp_path, frequency_hz=0.25, x=axis, y=axis, **bogus)
    with pytest.raises(TypeError, match=r"sweep_part\(\) got an unexpected keyword argument 'bogus'"):
        duffing.sweep_part((1, 2), tmp_path, starts=3, **bogus)
    rows: Any = np.array([1.0, 2.0])
    asked: list[dict[str, Any]] = [
        {"starts": rows},
        {"starts": 2, "initial": rows},
        {"starts": rows, "initial": rows},
    ]
    for given in asked:
        with pytest.raises(BadInput, match="starts"):
            duffing.sweep(**given, progress=False)
    with pytest.raises(BadInput, match="down: found array"):
        duffing.sweep(down=rows, progress=False)
