"""Files that are there whole or not at all."""

import os
import shutil
import threading
from collections.abc import Callable
from pathlib import Path
from typing import IO, Any


def write_whole(path: Path, text: str) -> None:
    """Writes a text, also after a loss of power."""
    _replace(path, lambda file: file.write(text.encode("utf-8")))


def copy_whole(source: Path, path: Path) -> None:
    """Copies a file. Where a link was the copy is afterwards, not where the link led to."""
    with source.open("rb") as original:
        _replace(path, lambda file: shutil.copyfileobj(original, file))


def _replace(path: Path, write: Callable[[IO[bytes]], Any]) -> None:
    # Two threads write two files.
    temporary = path.with_name(f".{path.name}.{os.getpid()}-{threading.get_ident()}")
    try:
        with temporary.open("wb") as file:
            write(file)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
