"""Matrices of a study that was built in Python: where they lie, and that results keep them."""

import filecmp
import shutil
import tempfile
import weakref
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ._errors import BadInput
from ._files import copy_whole, write_whole
from ._matrices import write_bundle
from ._native import NativeStudy


class Bundle:
    """A temporary folder with the matrices of a study. It goes with the last study that shares it.

    * `folder`: holds `study.toml`, `K.mtx`, `M.mtx` and so on.
    """

    def __init__(
        self,
        matrices: Mapping[str, Any],
        points: Mapping[str, int],
        fixed: Sequence[int],
        tables: Mapping[str, Any],
    ) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="hammerbeam-"))
        weakref.finalize(self, shutil.rmtree, self.folder, ignore_errors=True)
        write_bundle(self.folder, matrices, points, fixed, tables)

    def study(self, text: str | None = None) -> NativeStudy:
        """The study of the matrices: the one that was written, or that of another text."""
        path = self.folder / "study.toml"
        return NativeStudy.read(path) if text is None else NativeStudy.parse(str(path), self.local(text))

    def local(self, text: str) -> str:
        """A text of a study with the names of these matrices relative to their folder."""
        for path in self.folder.glob("*.mtx"):
            text = text.replace(f"'{path}'", f'"{path.name}"')
        return text

    def placed(self, text: str, out: Path) -> NativeStudy:
        """The study of a text, reading copies of the matrices in `structure` of a results or batch folder.

        Copies that are there already and equal are taken as they are. Other matrices are replaced as long
        as the folder holds nothing that was computed from them, else `BadInput` is raised, as it is if
        `structure` is a link.
        """
        place = out / "structure"
        if place.is_symlink():
            raise BadInput(f"{place}: it is a link, and nothing is written through links")
        names = sorted(path.name for path in self.folder.glob("*.mtx"))
        if any(not _equal(self.folder / name, place / name) for name in names):
            has_copies = any(place.glob("*.mtx"))
            if has_copies and any((out / used).exists() for used in ("results.db", "items")):
                raise BadInput(
                    f"{out}: what it holds belongs to other matrices, which are in {place}; "
                    "allowed: the same matrices, or another folder"
                )
            place.mkdir(parents=True, exist_ok=True)
            for name in names:
                copy_whole(self.folder / name, place / name)
        path, text = place / "study.toml", self.local(text)
        if not path.exists() or not (out / "results.db").exists():
            write_whole(path, text)
        return NativeStudy.parse(str(path), text)


def _equal(one: Path, other: Path) -> bool:
    return other.is_file() and filecmp.cmp(one, other, shallow=False)
