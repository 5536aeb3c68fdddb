"""Steady-state vibration of structures with impacts.

A `Study` says what a structure is and what shakes it. Its methods do what the commands of `hammerbeam` do,
and give NumPy arrays; `Results` reads a results folder. Units are SI, frequencies are in hertz where a name
ends in `_hz`.

    import hammerbeam

    study = hammerbeam.Study.read("studies/duffing.toml")
    results = study.run("results/duffing")
    results.plot()
"""

from ._errors import (
    AttractorError,
    BadInput,
    ClosedResults,
    CoordinateError,
    DrawingError,
    Drifts,
    ExportError,
    FallingFrequencies,
    FrequencyNotResolved,
    HammerbeamError,
    HammerbeamWarning,
    InitialStateError,
    Interrupted,
    NoResult,
    NoSearch,
    RunError,
    SimulationTooLarge,
    StoreError,
    StudyError,
    WriteError,
)
from ._model import Modes
from ._motions import Basins, Exponents, Motion, Sweep
from ._native import version as _version
from ._orbits import Orbit, Orbits
from ._results import Page, Results
from ._study import Study
from ._tables import frame

__version__ = _version()

__all__ = [
    "AttractorError",
    "BadInput",
    "Basins",
    "ClosedResults",
    "CoordinateError",
    "DrawingError",
    "Drifts",
    "Exponents",
    "ExportError",
    "FallingFrequencies",
    "FrequencyNotResolved",
    "HammerbeamError",
    "HammerbeamWarning",
    "InitialStateError",
    "Interrupted",
    "Modes",
    "Motion",
    "NoResult",
    "NoSearch",
    "Orbit",
    "Orbits",
    "Page",
    "Results",
    "RunError",
    "SimulationTooLarge",
    "StoreError",
    "Study",
    "StudyError",
    "Sweep",
    "WriteError",
    "frame",
]
