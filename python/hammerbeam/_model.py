"""A structure with its stops and its excitation: how it is made, what it says, its eigenfrequencies."""

import json
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, Self

import numpy as np

from . import _check
from ._bundle import Bundle
from ._errors import BadInput
from ._matrices import write_bundle
from ._native import NativeStudy
from ._toml import study_text

AnyPath = str | PathLike[str]


def loads(document: str) -> dict[str, Any]:
    """A document of the command."""
    found: dict[str, Any] = json.loads(document)
    return found


class Modes:
    """Eigenfrequencies before and after the reduction, and mode shapes at points.

    * `frequency_hz`: of the equations of motion [Hz]; `clamped_hz`: as supported; `free_interface_hz`,
      `fixed_interface_hz`, `reduced_hz`: of the reduction.
    * `shapes`: of each point by its name, mass-normalised.
    * `report`: as `modes --json` says.
    """

    def __init__(self, report: Mapping[str, Any], check: Mapping[str, Any]) -> None:
        self.report = report
        self.frequency_hz = np.array(check["eigenfrequencies_hz"], dtype=float)
        self.clamped_hz = np.array(report["clamped_hz"], dtype=float)
        self.free_interface_hz = np.array(report["free_interface_hz"], dtype=float)
        self.fixed_interface_hz = np.array(report["fixed_interface_hz"], dtype=float)
        self.reduced_hz = np.array(report["reduced_hz"], dtype=float)
        self.shapes = {name: np.array(shape) for name, shape in report["mass_normalised_shapes"].items()}

    def __repr__(self) -> str:
        return f"<Modes {np.array2string(self.frequency_hz, precision=6, threshold=8)} Hz>"


class Model:
    """What `Study` says of itself; `Study` adds what can be asked of it."""

    def __init__(self, native: NativeStudy, bundle: Bundle | None = None) -> None:
        if not isinstance(native, NativeStudy):
            raise BadInput(
                f"found {native!r}; a study is made by Study.read(path), Study.parse(text), "
                "Study.from_dict(tables) or Study.from_matrices(M, K, ...)"
            )
        self._native, self._bundle = native, bundle

    @classmethod
    def read(cls, path: AnyPath) -> Self:
        """Reads a study file."""
        return cls(NativeStudy.read(_check.folder("path", path)))

    @classmethod
    def parse(cls, text: str, folder: AnyPath = ".") -> Self:
        """Reads a study from a text in the form of a study file.

        * `folder`: to which names of files in it are relative.
        """
        if not isinstance(text, str):
            raise _check.refused("text", text, "must be a text in the form of a study file")
        try:
            text.encode()
        except UnicodeEncodeError:
            raise BadInput("text: must be Unicode") from None
        return cls(NativeStudy.parse(str(_check.folder("folder", folder) / "study"), text))

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any], folder: AnyPath = ".") -> Self:
        """A study from a dictionary with the tables and keys of a study file."""
        return cls.parse(study_text(tables), folder)

    @classmethod
    def from_matrices(
        cls,
        M: Any,
        K: Any,
        C: Any = None,
        *,
        points: Mapping[str, int],
        fixed: Sequence[int] = (),
        folder: AnyPath | None = None,
        **tables: Any,
    ) -> Self:
        """A study of a structure given by its matrices, in SI units.

        * `M`, `K`, `C`: mass, stiffness and damping, symmetric, of n rows: arrays, or sparse matrices of
          SciPy.
        * `points`: rows by names, from 0 on; stops, loads and the response go by these names.
        * `fixed`: rows that are held.
        * `folder`: where `K.mtx`, `M.mtx`, `C.mtx` and `study.toml` are written; by default somewhere
          temporary, and with the results of a run into its folder.
        * `tables`: further tables of the study file: `excitation`, `stop` (a list), `load`, `reduction`,
          `response`, `title` and so on.
        """
        matrices = {"K": K, "M": M, "C": C}
        if folder is not None:
            return cls.read(write_bundle(_check.folder("folder", folder), matrices, points, fixed, tables))
        bundle = Bundle(matrices, points, fixed, tables)
        return cls(bundle.study(), bundle)

    @property
    def text(self) -> str:
        """The study file."""
        return self._native.text

    def text_with(self, settings: Mapping[str, Any]) -> str:
        """The study file with other values of its keys, as `--set` of the command gives them.

        * `settings`: values by keys such as `stop.1.gap_m`; a text may have its unit, as in `"2 mm"`.
        """
        if not isinstance(settings, Mapping):
            raise _check.refused("settings", settings, "must be a dictionary of values by keys")
        return self._native.text_with([_check.setting(key, value) for key, value in settings.items()])

    def with_values(self, settings: Mapping[str, Any]) -> Self:
        """The study with other values of its keys, on the same structure.

        * `settings`: as in `text_with`.

        Matrices of `from_matrices` are shared, and kept as long as one of the studies is there.
        """
        text = self.text_with(settings)
        if self._bundle is None:
            return type(self)(NativeStudy.parse(self._native.name, text))
        return type(self)(self._bundle.study(text), self._bundle)

    @property
    def title(self) -> str:
        """Its title."""
        return self._native.title

    @property
    def dof(self) -> int:
        """Number of modes n; a state has 2n entries."""
        return self._native.dof

    @property
    def points(self) -> list[str]:
        """Names of the points of the structure."""
        return self._native.points

    @property
    def range_hz(self) -> tuple[float, float] | None:
        """Range of the excitation frequency [Hz], if there is an excitation."""
        return self._native.range_hz

    def check(self) -> dict[str, Any]:
        """What was understood, as `check --json` says."""
        return loads(self._native.check())

    def modes(self) -> Modes:
        """Eigenfrequencies and mode shapes."""
        return Modes(loads(self._native.modes()), self.check())

    def placed(self, folder: AnyPath) -> Self:
        """The same study, with matrices that are somewhere temporary copied into a folder, which goes on
        being read."""
        return type(self)(self._placed(_check.folder("folder", folder)))

    def _placed(self, out: Path | None) -> NativeStudy:
        """The study, with matrices that are somewhere temporary copied to its results, which go on being
        read."""
        if self._bundle is None or out is None:
            return self._native
        return self._bundle.placed(self.text, out)

    def __repr__(self) -> str:
        return f"<Study {self.title or self._native.name!r}, {self.dof} modes>"

    def _repr_markdown_(self) -> str:
        return f"**{self.title}**\n\n```toml\n{self.text.strip()}\n```"
