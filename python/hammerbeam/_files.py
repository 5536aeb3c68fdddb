"""Files that are there whole or not at all."""

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def whole_files(folder: Path) -> Iterator[Path]:
    """A folder within `folder` for files that are being written. They are moved to `folder` when the block
    ends, also after a loss of power whole; if it raises, everything is as it was before.

    Where a link was the file is afterwards, not where the link led to.
    """
    with tempfile.TemporaryDirectory(prefix=".unfinished-", dir=folder) as unfinished:
        place = Path(unfinished)
        yield place
        files = sorted(place.iterdir())
        for path in files:
            with path.open("rb") as file:
                os.fsync(file.fileno())
        for path in files:
            path.replace(folder / path.name)


def write_whole(path: Path, text: str) -> None:
    """Writes a text."""
    with whole_files(path.parent) as place:
        (place / path.name).write_bytes(text.encode("utf-8"))


def copy_whole(source: Path, path: Path) -> None:
    """Copies a file."""
    with whole_files(path.parent) as place:
        shutil.copyfile(source, place / path.name)
