"""Formulas without a network: MathJax draws them in the reader's browser, from one file beside the pages.

The file comes with the package `sphinx-mathjax-offline`. It draws outlines, so it needs no fonts, and pages
opened from a folder show formulas in every browser. (MathML was tried: without a mathematical font browsers
drop the dots of time derivatives and do not stretch brackets.)
"""

import shutil
from importlib.util import find_spec
from pathlib import Path

SCRIPT = "tex-svg.js"


def copy_script(app, exception):
    if exception is None and app.builder.format == "html":
        package = Path(find_spec("sphinx-mathjax-offline").origin).parent
        folder = Path(app.outdir) / "_static" / "mathjax"
        folder.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(package / "static" / "mathjax" / SCRIPT, folder / SCRIPT)


def setup(app):
    app.setup_extension("sphinx.ext.mathjax")
    app.config.mathjax_path = f"mathjax/{SCRIPT}"
    app.config.html_static_path.append(str(Path(__file__).parent / "static"))
    app.add_css_file("formulas.css")
    app.connect("build-finished", copy_script)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
