"""Checks that every test, test file and source file that the pages of the book name in backticks exists, and
every equation that a comment in the code cites.

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
    labels = {
        label
        for page in DOCS.rglob("*.md")
        for label in re.findall(r"^:label: (\w+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    }
    for path in sources:
        for cited in re.findall(r"Equations? (.*?) of the book", path.read_text(encoding="utf-8")):
            faults += [
                f"{path}: no equation ({label})"
                for label in re.findall(r"\(([A-Z]\d+)\)", cited)
                if label not in labels
            ]
    print("\n".join(faults) or f"{len(pages)} pages name what exists")
    return 1 if faults else 0


if __name__ == "__main__":
    given = [Path(page) for page in sys.argv[1:]]
    sys.exit(main(given or [DOCS / page for page in PAGES] + sorted((DOCS / "theory").glob("*.md"))))
