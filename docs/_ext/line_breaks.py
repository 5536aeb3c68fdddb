"""Where a line may end. Browsers part `--step` behind its hyphens, `1e-9` before the 9, and "5 %" before the
sign. The long name of a test, which has no hyphen, they part at any letter or not at all."""

import re

from docutils.nodes import SkipNode
from sphinx.writers.html5 import HTML5Translator

UNITS = r"(?:%|(?:[kM]?Hz|[nµm]?m|[mkM]?N|m?s|[kMG]?Pa|k?g|rad|[kMG]i?B|1/s|pixels)(?!\w))"
UNIT = re.compile(rf"(?<=\d) (?={UNITS}|\d{{3}}(?!\d)|±)|(?<=±) (?=\d)")
UNIT_OF_FORMULA = re.compile(rf"^ (?={UNITS})")
NUMBER = re.compile(r"[-+−]?\d+(?:\.\d+)?e-\d+")
OPTION = re.compile(r"(?<![\w-])--[a-z][a-z-]*")
NAME = re.compile(r"(?<![\w/.-])-{0,2}\w[\w.]*(?:-[\w.]+)*(?![\w/-])")
#: Longer names may be parted: at their hyphens, and behind underscores and slashes.
LONGEST_WHOLE = 20
#: Code of so many lines is not parted by the end of a page.
SHORT = 15


def whole(match):
    return f'<span class="whole">{match[0]}</span>'


def name(match):
    return whole(match) if "-" in match[0] and len(match[0]) <= LONGEST_WHOLE else match[0]


def inline_code(text):
    if len(text) > LONGEST_WHOLE - 4:
        text = re.sub(r"(?<=\w)([_/])(?=\w)", r"\1<wbr>", text)
    return NAME.sub(name, text)


def code_block(text):
    return NUMBER.sub(whole, OPTION.sub(whole, text))


def prose(text):
    return NUMBER.sub(whole, UNIT.sub("\N{NO-BREAK SPACE}", text))


def behind_formula(text):
    return UNIT_OF_FORMULA.sub("\N{NO-BREAK SPACE}", prose(text))


def texts(html, change):
    """Applies a change to the texts between the tags."""
    parts = re.split(r"(<[^>]*>)", html)
    return "".join(part if part.startswith("<") else change(part) for part in parts)


class Translator(HTML5Translator):
    """The pages of Sphinx with better places for the ends of lines. What is copied of code stays the same."""

    def visit_Text(self, node):
        start = len(self.body)
        is_behind_formula = start > 0 and self.body[-1].endswith(r"\)</span>")
        change = behind_formula if is_behind_formula else prose
        change = inline_code if self.protect_literal_text else change
        super().visit_Text(node)
        self.body[start:] = [texts(part, change) for part in self.body[start:]]

    def visit_literal_block(self, node):
        start = len(self.body)
        try:
            super().visit_literal_block(node)
        except SkipNode:
            html = texts("".join(self.body[start:]), code_block)
            if html.count("\n") <= SHORT:
                html = html.replace(' notranslate"', ' notranslate short"', 1)
            self.body[start:] = [html]
            raise


def setup(app):
    app.set_translator("html", Translator)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
