"""How Sphinx makes the book from the pages in this folder; docs/build.sh runs it."""

import logging as std_logging
import re
import sys
from pathlib import Path

from pygments.lexers.special import TextLexer
from sphinx.util import logging

project = "Hammerbeam"
author = "the Hammerbeam authors"
copyright = "the Hammerbeam authors"
html_title = "Hammerbeam"

# Equations are numbered by their labels, as (F3), which comments in the code cite.
sys.path.insert(0, str(Path(__file__).parent / "_ext"))
extensions = ["myst_parser", "equation_labels", "line_breaks", "offline_formulas"]
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
# The search finds everything; an index of Python or C names would be empty.
html_use_index = False
# Summaries of what is found are fetched, which browsers refuse for files.
html_show_search_summary = False


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
    """Names the check of links."""
    app.add_lexer("csv", TextLexer)
    app.add_css_file("pages.css")
    app.connect("source-read", links_out_of_the_book)
