"""Studies and what is asked of them: numbers known in closed form, printed, or asserted by the tests in
Rust."""

import gc
import math
import threading
import warnings
from pathlib import Path

import hammerbeam
import numpy as np
import pytest
from conftest import STUDIES
from hammerbeam import Study

OSCILLATOR = {
    "title": "Oscillator",
    "structure": {
        "kind": "lumped",
        "mass": [{"name": "mass", "mass_kg": 1.0}],
        "spring": [{"between": ["mass", "ground"], "stiffness_n_m": 1.0}],
        "damper": [{"between": ["mass", "ground"], "damping_n_s_m": 0.1}],
    },
    "excitation": {"kind": "force", "at": "mass", "amplitude_n": 0.5, "frequency_hz": [0.1, 0.2]},
    "response": {"point": "mass"},
}


def chain(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Equal masses on equal springs, held at one end."""
    stiffness = 2.0 * np.eye(count) - np.eye(count, k=1) - np.eye(count, k=-1)
    stiffness[-1, -1] = 1.0
    return np.eye(count), stiffness


def chain_hz(count: int, mode: int) -> float:
    """Its eigenfrequencies, in closed form."""
    return 2.0 * math.sin((2 * mode - 1) * math.pi / (2 * (2 * count + 1))) / (2 * math.pi)


def test_a_driven_oscillator_swings_at_its_own_frequency_with_the_force_over_damping() -> None:
    orbit = Study.from_dict(OSCILLATOR).orbit(1 / (2 * math.pi))
    assert abs(orbit.max_abs_displacement_m - 5.0) < 1e-8
    assert orbit.stable and orbit.branch is None and orbit.period_multiple == 1
    moduli = abs(orbit.multipliers)
    np.testing.assert_allclose(moduli, math.exp(-0.05 * 2 * math.pi), rtol=1e-9)


def test_the_motion_of_an_orbit_is_that_of_the_closed_form() -> None:
    study = Study.from_dict(OSCILLATOR)
    waveform = study.orbit(1 / (2 * math.pi)).waveform(64)
    assert len(waveform) == 64 and waveform["state"].shape == (64, 2)
    time = waveform["time_s"]
    # At resonance x = F/(c w) sin t.
    np.testing.assert_allclose(waveform["mass_displacement_m"], 5.0 * np.sin(time), atol=1e-8)
    np.testing.assert_allclose(waveform["mass_velocity_m_s"], 5.0 * np.cos(time), atol=1e-8)
    np.testing.assert_allclose(waveform["mass_acceleration_m_s2"], -5.0 * np.sin(time), atol=1e-8)


def test_file_text_and_dictionary_are_the_same_study(duffing: Study) -> None:
    again = Study.parse(duffing.text)
    assert again.check()["identity"] == duffing.check()["identity"]
    import tomllib

    built = Study.from_dict(tomllib.loads(duffing.text))
    assert built.check()["identity"] == duffing.check()["identity"]


def test_the_beam_has_the_printed_eigenfrequencies() -> None:
    modes = Study.read(STUDIES / "beam-with-stop.toml").modes()
    np.testing.assert_allclose(modes.clamped_hz[0], 17.495, rtol=6e-5)
    assert modes.free_interface_hz[0] == 0.0
    assert len(modes.reduced_hz) == 6 and "contact" in modes.shapes


@pytest.mark.parametrize("sparse", [False, True])
def test_a_chain_from_matrices_has_its_eigenfrequencies(sparse: bool, tmp_path: Path) -> None:
    mass, stiffness = chain(12)
    if sparse:
        scipy_sparse = pytest.importorskip("scipy.sparse")
        mass, stiffness = scipy_sparse.csr_array(mass), scipy_sparse.csc_array(stiffness)
    study = Study.from_matrices(
        mass,
        stiffness,
        points={"tip": 11},
        excitation={"kind": "force", "at": "tip", "amplitude_n": 1.0, "frequency_hz": [0.01, 0.03]},
        reduction={"method": "truncation", "cut_off_hz": 0.2},
        damping={"modal_ratio": 0.02},
        stop=[{"at": "tip", "law": "linear", "stiffness_n_m": 1.0, "gap_m": 5.0, "side": "above"}],
    )
    expected = [chain_hz(12, mode) for mode in range(1, study.dof + 1)]
    np.testing.assert_allclose(study.modes().frequency_hz, expected, rtol=1e-10)
    results = study.run(tmp_path / "out", progress=False, figures=False)
    # The matrices are with the results, so their orbits can be computed again without this study.
    del study
    orbit = hammerbeam.Results(results.folder).orbits(0.02)[0]
    assert "tip_force_n" not in (orbit.waveform(8).dtype.names or ())
    assert any(name.endswith("_force_n") for name in orbit.waveform(8).dtype.names or ())


def matrices_with_a_stop(stiffness_n_m: float = 100.0) -> Study:
    """Two masses, the outer one with a stop that it reaches."""
    return Study.from_matrices(
        np.diag([2.0, 1.0]),
        np.array([[300.0, -stiffness_n_m], [-stiffness_n_m, 100.0]]),
        points={"base": 0, "tip": 1},
        excitation={"kind": "force", "at": "base", "amplitude_n": 1.0, "frequency_hz": [1.0, 1.2]},
        damping={"modal_ratio": 0.02},
        reduction={"method": "none"},
        search={"frequencies": 2, "starts": 1, "trials": 1},
        stop=[{"at": "tip", "law": "linear", "stiffness_n_m": 1e4, "gap_m": 0.02, "side": "above"}],
    )


def test_results_of_matrices_are_readable_after_the_same_call_again(tmp_path: Path) -> None:
    out = tmp_path / "out"
    # What a call leaves that was stopped while it copied the matrices.
    (out / "structure").mkdir(parents=True)
    (out / "structure/K.mtx").write_text("%%MatrixMarket")
    tables = []
    for _ in range(2):
        matrices_with_a_stop().run(out, jobs=1, progress=False, figures=False).close()
        with hammerbeam.Results(out) as results:
            tables.append(results.branches())
            assert len(results.orbits(1.1)) > 0
    first, second = tables
    np.testing.assert_array_equal(first, second)
    with pytest.raises(hammerbeam.BadInput, match="belongs to other matrices"):
        matrices_with_a_stop(90.0).run(out, jobs=1, progress=False, figures=False)
    with hammerbeam.Results(out) as results:
        np.testing.assert_array_equal(results.branches(), tables[0])


def test_an_interrupted_run_of_matrices_goes_on(tmp_path: Path) -> None:
    class Enough(Exception):
        pass

    def stop(part: float | None, words: str) -> None:
        raise Enough

    out = tmp_path / "out"
    with pytest.raises(Enough):
        matrices_with_a_stop().run(out, jobs=1, progress=stop, figures=False)
    matrices_with_a_stop().run(out, jobs=1, progress=False, figures=False).close()
    with hammerbeam.Results(out) as results:
        assert len(results.branches()) > 0 and "K.mtx" in results.study.text


def test_a_study_with_other_values_keeps_the_matrices(tmp_path: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        study = matrices_with_a_stop()
        folder = study._bundle.folder if study._bundle is not None else tmp_path
        other = study.with_values({"stop.1.gap_m": 0.03})
        del study
        gc.collect()
        assert "gap_m = 0.03" in other.text and other.dof == 2
        # (300 - 2 w)(100 - w) = 100^2 for the square w of the angular frequency: 50 and 200.
        expected = np.sqrt([50.0, 200.0]) / (2 * math.pi)
        np.testing.assert_allclose(other.modes().frequency_hz, expected, rtol=1e-12)
        other.simulate(1.1, periods=2, out=tmp_path / "out", progress=False)
        assert (tmp_path / "out/structure/K.mtx").is_file()
        del other
        gc.collect()
        assert not folder.exists()


def test_a_study_of_a_file_with_other_values(duffing: Study) -> None:
    other = duffing.with_values({"structure.mass.1.mass_kg": 4.0})
    ratio = other.modes().frequency_hz / duffing.modes().frequency_hz
    np.testing.assert_allclose(ratio, 0.5, rtol=1e-12)


def test_a_damping_matrix_counts(tmp_path: Path) -> None:
    mass, stiffness = chain(1)
    study = Study.from_matrices(
        mass,
        stiffness,
        0.1 * np.eye(1),
        points={"mass": 0},
        folder=tmp_path / "bundle",
        excitation={"kind": "force", "at": "mass", "amplitude_n": 0.5, "frequency_hz": [0.1, 0.2]},
        reduction={"method": "none"},
    )
    assert abs(study.orbit(1 / (2 * math.pi)).max_abs_displacement_m - 5.0) < 1e-8
    assert sorted(path.name for path in (tmp_path / "bundle").iterdir()) == [
        "C.mtx",
        "K.mtx",
        "M.mtx",
        "study.toml",
    ]


def test_all_orbits_between_the_folds(duffing: Study) -> None:
    orbits = duffing.orbits(0.25)
    assert len(orbits) == 3
    assert [orbit.stable for orbit in orbits].count(True) == 2
    assert len(orbits[:2]) == 2 and orbits[-1].frequency_hz == 0.25
    assert orbits.table["multipliers"].shape == (3, 2)


def test_a_free_motion_decays_as_its_damping_says() -> None:
    tables = {key: value for key, value in OSCILLATOR.items() if key != "excitation"}
    motion = Study.from_dict(tables).simulate(duration_s=10.0, initial={"mass.y": 1.0})
    time = motion.samples["time_s"]
    rate = math.sqrt(1 - 0.05**2)
    expected = np.exp(-0.05 * time) * (np.cos(rate * time) + 0.05 / rate * np.sin(rate * time))
    np.testing.assert_allclose(motion.samples["displacement_m"], expected, atol=1e-9)


def test_a_simulation_has_its_contacts(oscillator: Study, tmp_path: Path) -> None:
    motion = oscillator.simulate(0.15, periods=5, transient_periods=2, out=tmp_path / "out")
    assert len(motion.samples) == 500 and len(motion.section) == 5
    assert len(motion.contacts) == motion.report["contacts"] > 0
    assert motion.section["state"].shape == (5, 2)
    again = oscillator.simulate(0.15, periods=5, transient_periods=2, initial=[0.0, 0.0])
    np.testing.assert_array_equal(motion.samples, again.samples)


def test_a_sweep_goes_up_and_down(duffing: Study) -> None:
    sweep = duffing.sweep(0.2, 0.3, 0.02, down=True, progress=False)
    assert len(sweep.motions) == 12
    assert set(sweep.motions["class"]) == {"periodic"}
    at = sweep.motions[np.isclose(sweep.motions["frequency_hz"], 0.26)]
    # Between the folds the way up and the way down differ.
    assert at["max_abs_displacement_m"].max() > 2 * at["max_abs_displacement_m"].min()


def test_exponents_of_an_oscillator_are_half_its_damping(duffing: Study) -> None:
    found = Study.from_dict(OSCILLATOR).lyapunov(0.15, periods=100)
    # Their sum is known at any time, each of them to the inverse of the time averaged over.
    np.testing.assert_allclose(found.exponents_per_s.sum(), -0.1, rtol=1e-9)
    np.testing.assert_allclose(found.exponents_per_s, [[-0.05, -0.05]], atol=0.15 / 100)
    assert found.frequency_hz.tolist() == [0.15]


def test_basins_have_both_attractors(duffing: Study) -> None:
    basins = duffing.basins(0.25, ("q1", -2.0, 2.0), ("v1", -3.0, 3.0), grid=8, progress=False)
    assert basins.cells.shape == (8, 8) and len(basins.x) == 8
    assert len(basins.attractors) == 2 and set(np.unique(basins.cells)) == {1, 2}


def test_progress_is_reported(duffing: Study, tmp_path: Path) -> None:
    seen: list[tuple[float | None, str]] = []
    duffing.run(
        tmp_path / "out", jobs=1, progress=lambda part, words: seen.append((part, words)), figures=False
    )
    assert seen and all(part is None or 0.0 <= part <= 1.0 for part, _ in seen)


def test_an_exception_in_progress_stops_the_work_and_what_is_done_is_kept(
    duffing: Study, tmp_path: Path
) -> None:
    class Enough(Exception):
        pass

    def stop(part: float | None, words: str) -> None:
        raise Enough

    with pytest.raises(Enough):
        duffing.run(tmp_path / "out", jobs=1, progress=stop, figures=False)
    whole = duffing.run(tmp_path / "out", progress=False, figures=False)
    other = duffing.run(tmp_path / "other", progress=False, figures=False)
    np.testing.assert_array_equal(whole.branches(), other.branches())


def test_two_studies_from_two_threads(duffing: Study, oscillator: Study, tmp_path: Path) -> None:
    alone = [
        study.run(tmp_path / f"alone{k}", jobs=1, progress=False, figures=False).branches()
        for k, study in enumerate((duffing, oscillator))
    ]
    found: dict[int, np.ndarray] = {}

    def work(number: int, study: Study) -> None:
        found[number] = study.run(
            tmp_path / f"both{number}", jobs=1, progress=False, figures=False
        ).branches()

    threads = [
        threading.Thread(target=work, args=(k, study)) for k, study in enumerate((duffing, oscillator))
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for number, rows in enumerate(alone):
        np.testing.assert_array_equal(found[number], rows)
