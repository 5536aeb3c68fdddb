"""How Sphinx makes the book from the pages in this folder; docs/build.sh runs it."""

import logging as std_logging
import re
import sys
from importlib.util import find_spec
from pathlib import Path

from docutils.nodes import SkipNode
from latex2mathml.converter import convert
from pygments.lexers.special import TextLexer
from sphinx.util import logging
from sphinx.util.math import get_node_equation_number

project = "Hammerbeam"
author = "the Hammerbeam authors"
copyright = "the Hammerbeam authors"
html_title = "Hammerbeam"

extensions = ["myst_parser"]
# Equations have their labels for numbers, so that code can cite them.
sys.path.insert(0, str(Path(__file__).parent / "_ext"))
if find_spec("equation_labels"):
    extensions.append("equation_labels")
myst_enable_extensions = ["dollarmath", "deflist", "attrs_block"]
myst_dmath_double_inline = True
# Headings down to this level can be linked to, as page.md#heading; a link to a missing one is an error.
myst_heading_anchors = 4

source_suffix = {".md": "markdown"}
# A part of the book may still be without pages.
std_logging.getLogger("sphinx").addFilter(lambda record: "toctree glob pattern" not in str(record.msg))

# Nothing is fetched from a network, neither while building nor while reading.
highlight_language = "text"
html_theme = "furo"
html_theme_options = {"top_of_page_buttons": []}
html_copy_source = False
html_show_sphinx = False
html_math_renderer = "mathml"


# What the converter to MathML has under another name.
SAME_ENVIRONMENTS = {
    r"\begin{aligned}": r"\begin{split}",
    r"\end{aligned}": r"\end{split}",
    r"\begin{bmatrix}": r"\left[\begin{matrix}",
    r"\end{bmatrix}": r"\end{matrix}\right]",
}


def mathml(formula, display):
    """A formula as MathML, which the reader's browser draws without a script."""
    for theirs, ours in SAME_ENVIRONMENTS.items():
        formula = formula.replace(theirs, ours)
    return convert(formula, display=display)


def inline_formula(writer, node):
    """A formula within a line."""
    writer.body.append(mathml(node.astext(), "inline"))
    raise SkipNode


def displayed_formula(writer, node):
    """A formula on a line of its own, with its number on the right."""
    number = f"({get_node_equation_number(writer, node)})" if node["number"] else ""
    writer.body.append(f'<div class="math" id="{node["ids"][0] if node["ids"] else ""}">')
    writer.body.append(f'<span class="eqno">{number}</span>{mathml(node.astext(), "block")}</div>')
    raise SkipNode


def links_out_of_the_book(app, page, source):
    """Checks links to files of the project that are no pages. Files can be saved from the book; folders and
    pages for developers stay as text."""
    here = Path(app.env.doc2path(page)).parent
    book = Path(app.srcdir).resolve()

    def checked(link):
        target = (here / link["target"]).resolve()
        if target.is_relative_to(book):
            return link[0]
        if not target.exists():
            logging.getLogger(__name__).warning("%s: %s does not exist", page, link["target"])
        return link[0] if target.is_file() and target.suffix != ".md" else link["text"]

    source[0] = re.sub(r"(?<!!)\[(?P<text>[^\]]*)\]\((?P<target>\.\./[^)#\s]*)(#[^)\s]*)?\)", checked, source[0])


def setup(app):
    """Names the renderer of formulas and the check of links."""
    app.add_lexer("csv", TextLexer)
    app.connect("source-read", links_out_of_the_book)
    app.add_html_math_renderer("mathml", (inline_formula, None), (displayed_formula, None))
