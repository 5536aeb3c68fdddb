"""A study as the simulation of Dakota: `python -m hammerbeam.dakota [STUDY] PARAMS RESULTS`.

Dakota writes a file of parameters, starts this, and reads a file of responses. Descriptors of its variables
are keys of the study, such as `stop.1.gap_m`; descriptors of its responses are numbers of a run, such as
`max_abs_displacement_m` (`hammerbeam.batch` has the same ones). Where there is no number the file of
responses says FAIL, and standard error why; what Dakota does then is set by its `failure_capture`.

* `STUDY`: the study file; without it the first analysis component, `analysis_components` in Dakota's input.
* `PARAMS`: parameters in Dakota's standard format or in that for APREPRO.
* `RESULTS`: where responses go.

Values alone are given: where Dakota asks for gradients or Hessians it has to make them itself, by
`numerical_gradients`.
"""

import re
import sys
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from ._check import refused
from ._errors import BadInput, HammerbeamError
from ._files import write_whole
from ._study import Study
from .batch._numbers import of_results

_VALUE = 1


@dataclass(frozen=True)
class Asked:
    """What a file of parameters asks for.

    * `variables`: values by descriptors, as texts.
    * `responses`: of each descriptor what is wanted: 1 the value, 2 the gradient, 4 the Hessian, or a sum
      of them.
    * `components`: the analysis components.
    """

    variables: dict[str, str]
    responses: dict[str, int]
    components: list[str]


def parse(text: str) -> Asked:
    """Reads a file of parameters, in either format."""
    if not isinstance(text, str):
        raise refused("text", text, "must be the text of a file of parameters")
    pairs = [pair for line in text.splitlines() if (pair := _pair(line)) is not None]
    variables, rest = _counted(pairs, ("variables", "DAKOTA_VARS"))
    functions, rest = _counted(rest, ("functions", "DAKOTA_FNS"))
    responses = {_tagged(name, "ASV"): int(value) for name, value in functions}
    components = [value for name, value in rest if name.startswith("AC_")]
    return Asked(dict(variables), responses, components)


def _pair(line: str) -> tuple[str, str] | None:
    """Descriptor and value of a line: `{ x = 1 }` for APREPRO, `1 x` else."""
    aprepro = re.fullmatch(r"\s*\{\s*(.+?)\s*=\s*(.*?)\s*\}\s*", line)
    if aprepro:
        return aprepro[1], aprepro[2].strip('"')
    words = line.split(maxsplit=1)
    return (words[1].strip(), words[0]) if len(words) == 2 else None


def _counted(
    pairs: Sequence[tuple[str, str]], names: tuple[str, str]
) -> tuple[list[tuple[str, str]], Sequence[tuple[str, str]]]:
    """The pairs behind the one that has their number, and what follows them."""
    for place, (name, value) in enumerate(pairs):
        if name in names and value.isdecimal():
            end = place + 1 + int(value)
            if end <= len(pairs):
                return list(pairs[place + 1 : end]), pairs[end:]
    raise BadInput(
        f"the file of parameters is not Dakota's: it has no number of {names[0]} with as many behind it"
    )


def _tagged(name: str, tag: str) -> str:
    """The descriptor in `ASV_1:descriptor`."""
    head, colon, descriptor = name.partition(":")
    if not colon or not head.startswith(tag):
        raise BadInput(f"the file of parameters is not Dakota's: found {name!r}, expected {tag}_1:DESCRIPTOR")
    return descriptor


def respond(study: str | Path, asked: Asked) -> str:
    """Runs the study with the values that Dakota gives: the file of responses."""
    if not isinstance(asked, Asked):
        raise refused("asked", asked, "must be what parse gives")
    derivatives = [name for name, wanted in asked.responses.items() if wanted & ~_VALUE]
    if derivatives:
        allowed = "numerical_gradients, no_hessians"
        raise BadInput(f"{', '.join(derivatives)}: only values are given; allowed in Dakota: {allowed}")
    given = Study.read(study)
    changed = Study.parse(given.text_with(asked.variables))
    with tempfile.TemporaryDirectory(prefix="hammerbeam-dakota-") as folder:
        with changed.run(Path(folder) / "results", jobs=1, progress=False, figures=False) as results:
            numbers = of_results(results)
    missing = [name for name, wanted in asked.responses.items() if wanted and name not in numbers]
    if missing:
        raise BadInput(f"the run gives no {', '.join(missing)}; it gives {', '.join(numbers)}")
    return "".join(f"{numbers[name]!r} {name}\n" for name, wanted in asked.responses.items() if wanted)


def main(arguments: Sequence[str]) -> int:
    """What Dakota starts. Its answer is the file of responses, so the exit code is 0 if there is one."""
    if len(arguments) not in (2, 3):
        print(__doc__, file=sys.stderr)
        return 2
    *study, params, results = arguments
    try:
        asked = parse(Path(params).read_text(encoding="utf-8"))
        if not study and not asked.components:
            raise BadInput("no study: give it in front of the files, or as the first of analysis_components")
        answer = respond((study or asked.components)[0], asked)
    except (HammerbeamError, OSError, ValueError) as error:
        print(f"error: {error}", file=sys.stderr)
        answer = "FAIL\n"
    write_whole(Path(results).absolute(), answer)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
