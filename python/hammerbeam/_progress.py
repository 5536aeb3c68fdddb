"""Progress in a terminal and in a notebook, and warnings."""

import sys
import time
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from ._check import refused
from ._errors import HammerbeamWarning, Interrupted

Report = Callable[[float | None, str], None]
"""Called with the part of the work that is done, 0 to 1, or `None`, and with words that say where the work
is."""

Progress = bool | None | Report
"""`True`: shown; `False`: not; `None`: shown where someone looks, a terminal or a notebook; or a function to
call."""

_WIDTH = 24


class _Terminal:
    """One line on standard error."""

    def __init__(self) -> None:
        self._length = 0

    def __call__(self, fraction: float | None, text: str) -> None:
        line = _line(fraction, text)
        sys.stderr.write("\r" + line.ljust(self._length))
        sys.stderr.flush()
        self._length = len(line)

    def close(self) -> None:
        if self._length:
            sys.stderr.write("\r" + " " * self._length + "\r")
            sys.stderr.flush()


class _Notebook:
    """One line of output that is replaced."""

    def __init__(self) -> None:
        self._handle: Any = None

    def __call__(self, fraction: float | None, text: str) -> None:
        from IPython.display import Pretty, display

        line = Pretty(_line(fraction, text))
        if self._handle is None:
            self._handle = display(line, display_id=True)
        else:
            self._handle.update(line)

    def close(self) -> None:
        if self._handle is not None:
            from IPython.display import Pretty

            self._handle.update(Pretty(""))


def _line(fraction: float | None, text: str) -> str:
    if fraction is None:
        return text
    done = round(_WIDTH * min(max(fraction, 0.0), 1.0))
    return f"[{'#' * done}{' ' * (_WIDTH - done)}] {100 * fraction:5.1f} %  {text}"


def _in_notebook() -> bool:
    shell = sys.modules.get("IPython")
    found = shell.get_ipython() if shell is not None else None
    return found is not None and type(found).__name__ == "ZMQInteractiveShell"


def _warn(text: str) -> None:
    warnings.warn(text.removeprefix("warning: "), HammerbeamWarning, stacklevel=4)


@contextmanager
def watched(progress: Progress) -> Iterator[tuple[Report | None, Callable[[str], None]]]:
    """The two callbacks of a job; takes the line away at the end."""
    if callable(progress):
        yield progress, _warn
        return
    if progress is not None and not isinstance(progress, bool):
        raise refused("progress", progress, "must be True, False, None or a function")
    if progress is None:
        # Without a console there is no standard error.
        progress = _in_notebook() or (sys.stderr is not None and sys.stderr.isatty())
    if not progress or (sys.stderr is None and not _in_notebook()):
        yield None, _warn
        return
    shown: _Terminal | _Notebook = _Notebook() if _in_notebook() else _Terminal()
    started = time.monotonic()

    def report(fraction: float | None, text: str) -> None:
        # Work of half a second needs no line.
        if time.monotonic() - started > 0.5:
            shown(fraction, text)

    try:
        yield report, _warn
    finally:
        shown.close()


@contextmanager
def interruptible(kept: str) -> Iterator[None]:
    """Says with Ctrl-C what is kept."""
    try:
        yield
    except Interrupted:
        raise
    except KeyboardInterrupt as error:
        raise Interrupted(f"interrupted; {kept}") from error
