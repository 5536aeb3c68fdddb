"""Equations are numbered by their labels: `:label: F3` is "(F3)" on the page and in every reference to it.

So comments in the code can cite an equation, and its number stays the same when another one is added.
"""

from sphinx.domains.math import MathDomain


class LabelledMath(MathDomain):
    """The mathematics of Sphinx, with the label in the place of the number."""

    def note_equation(self, docname, labelid, location=None):
        super().note_equation(docname, labelid, location)
        self.equations[labelid] = (docname, labelid)


def setup(app):
    app.add_domain(LabelledMath, override=True)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
