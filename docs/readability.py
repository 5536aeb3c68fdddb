"""Reports how long sentences are, page by page, and checks spelling; needs no network.

    python3 docs/readability.py [--check] [PAGE OR FOLDER ...]

Tables, code and headings are left out. With --check the exit code is 1 if a page has a sentence over 30 words, a
paragraph over five lines of 110 columns, or words that are neither in the dictionary nor in docs/words.txt.
"""

import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
LONG = 30
COLUMNS, MOST_LINES = 110, 5


def plain(text):
    """A page without code, formulas, pictures, links and markup."""
    text = re.sub(r"^(`{3,}|:{3,}).*?^\1\s*$", "", text, flags=re.M | re.S)
    text = re.sub(r"^\$\$.*?\$\$.*?$", "", text, flags=re.M | re.S)
    text = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", text)
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", text)
    text = re.sub(r"`[^`]*`", "x", text)
    text = re.sub(r"\$[^$]*\$", "x", text)
    return re.sub(r"<[^>]*>", "", text)


def prose(text):
    """The paragraphs of a page, without headings and tables."""
    text = plain(text)
    lines = [line for line in text.splitlines() if not re.match(r"\s*(\||#|\([\w-]+\)=)", line)]
    paragraphs, current = [], []
    for line in [*lines, ""]:
        if not line.strip() or re.match(r"\s*([-*]|\d+\.)\s", line):
            paragraphs.append(" ".join(current))
            current = []
        current.append(re.sub(r"^\s*([-*]|\d+\.)\s", "", line).strip())
    return [paragraph for paragraph in paragraphs if paragraph]


def sentences(paragraph):
    """Sentences of a paragraph: they end at a full stop, question mark or colon at the end of a line of thought."""
    parts = re.split(r"(?<=[.!?])[\"')*]*\s+(?=[*\"'(]*[A-Z0-9x])|:\s*$", paragraph)
    return [part for part in parts if part and part.split()]


def words(sentence):
    return [word for word in sentence.split() if re.search(r"\w", word)]


def too_long(text):
    """Sentences and paragraphs that are longer than a page may have."""
    for paragraph in prose(text):
        if len(paragraph) > COLUMNS * MOST_LINES:
            yield f"a paragraph of {-(-len(paragraph) // COLUMNS)} lines, \"{paragraph[:60]} ...\""
        for sentence in sentences(paragraph):
            if len(words(sentence)) > LONG:
                yield f"a sentence of {len(words(sentence))} words, \"{sentence.strip()[:60]} ...\""


# Names of libraries, written by a test.
GENERATED = {"third-party.md"}


def pages(arguments):
    for argument in map(Path, arguments):
        found = sorted(argument.rglob("*.md")) if argument.is_dir() else [argument]
        yield from (page for page in found if page.name not in GENERATED)


def misspelt(text, dictionary, own):
    """Words that nobody knows; names (upper case), numbers and anything in code are not looked at."""
    text = plain(text).replace("-", " ").replace("'s", "")
    candidates = set(re.findall(r"(?<![\w./\\])[a-z]{3,}(?![\w/])", text))
    return sorted(dictionary.unknown(candidates - own))


def main(arguments):
    check = "--check" in arguments
    chosen = [argument for argument in arguments if argument != "--check"] or [HERE]
    dictionary = own = None
    if check:
        from spellchecker import SpellChecker

        dictionary = SpellChecker(language="en", distance=1)
        own = set((HERE / "words.txt").read_text().split())
    lengths_of_all, faults = [], 0
    for page in pages(chosen):
        text = page.read_text()
        lengths = [len(words(sentence)) for paragraph in prose(text) for sentence in sentences(paragraph)]
        lengths_of_all += lengths
        if check:
            for fault in too_long(text):
                faults += 1
                print(f"{page}: {fault}")
            unknown = misspelt(text, dictionary, own)
            faults += len(unknown)
            for word in unknown:
                print(f"{page}: \"{word}\" is in neither dictionary; mend it or add it to docs/words.txt")
        elif lengths:
            report(str(page), text, lengths)
    if not check and lengths_of_all:
        report("all pages", "", lengths_of_all)
    return 1 if faults else 0


def report(name, text, lengths):
    long = sum(length > LONG for length in lengths)
    mean, share = sum(lengths) / len(lengths), 100 * long / len(lengths)
    size = f"{len(text.split()):6} words, " if text else ""
    print(f"{name:48} {size}{len(lengths):5} sentences, {mean:5.1f} words each, {share:5.1f} % over {LONG}")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
