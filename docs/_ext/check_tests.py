"""Checks that every test, test file and source file that the pages of the book name in backticks exists, that
every equation that a comment in the code cites does, and that some comment cites every equation.

    python docs/_ext/check_tests.py [PAGE ...]

Without pages: validation, performance, contact laws, theory, and what belongs to them.
"""

import re
import sys
from pathlib import Path

DOCS = Path(__file__).resolve().parents[1]
ROOT = DOCS.parent
PAGES = [
    "validation.md",
    "performance.md",
    "reference/contact-laws.md",
    "validation/completeness.md",
    "validation/conclusions.md",
    "validation/impact-oscillator.md",
]


CITATION = re.compile(r"Equations? ((?:\([A-Z]\d+\)|, | and | to )+) of the book")


def cited_by(text):
    """Labels of the equations that the comments of a source file cite; "(P1) to (P6)" are six."""
    text = re.sub(r"\n\s*//[/!]? ?", " ", text)
    for citation in CITATION.findall(text):
        for first, last in re.findall(r"\(([A-Z]\d+)\)(?: to \(([A-Z]\d+)\))?", citation):
            last = last or first
            yield from (f"{first[0]}{number}" for number in range(int(first[1:]), int(last[1:]) + 1))


def equations(sources):
    """What is wrong between the equations of the book and the comments in the code that cite them: each side has
    to know the other."""
    labels = {}
    for page in sorted(DOCS.rglob("*.md")):
        for label in re.findall(r"^:label: (\w+)$", page.read_text(encoding="utf-8"), re.MULTILINE):
            if label in labels:
                yield f"{page.name}: equation ({label}) stands in {labels[label]}, too"
            labels[label] = page.name
    cited = set()
    for path, text in sources.items():
        for label in cited_by(text):
            cited.add(label)
            if label not in labels:
                yield f"{path}: no equation ({label})"
    for label, page in labels.items():
        if label not in cited:
            yield f"{page}: no comment in the code cites equation ({label})"


def main(pages):
    sources = [
        path
        for part in ("crates", "verification")
        for path in (ROOT / part).rglob("*.rs")
        if "target" not in path.parts
    ]
    functions, names = set(), {path.name for path in sources}
    for path in sources:
        text = path.read_text(encoding="utf-8")
        functions.update(re.findall(r"\bfn\s+([a-z0-9_]+)", text))
        # Tests made by a macro: `name: rest` and `name => rest`, one a line.
        functions.update(re.findall(r"^\s*([a-z0-9_]{12,})\s*(?::|=>)", text, re.MULTILINE))
    faults = []
    for page in pages:
        text = page.read_text(encoding="utf-8")
        text = re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL)
        for name in re.findall(r"`([^`\n]+)`", text):
            if re.fullmatch(r"[a-z0-9]+(?:_[a-z0-9]+){4,}", name) and name not in functions:
                faults.append(f"{page.name}: no test {name}")
            if name.endswith(".rs"):
                found = (
                    (ROOT / name).exists()
                    if "/" in name and (ROOT / name.split("/")[0]).exists()
                    else Path(name).name in names
                )
                if not found:
                    faults.append(f"{page.name}: no file {name}")
            if re.fullmatch(r"(?:studies|verification)/[\w./-]+\.toml", name) and not (ROOT / name).exists():
                faults.append(f"{page.name}: no study {name}")
    faults += equations({path: path.read_text(encoding="utf-8") for path in sources})
    print("\n".join(faults) or f"{len(pages)} pages name what exists")
    return 1 if faults else 0


if __name__ == "__main__":
    given = [Path(page) for page in sys.argv[1:]]
    sys.exit(main(given or [DOCS / page for page in PAGES] + sorted((DOCS / "theory").glob("*.md"))))
