"""One picture for paper: SVG in the colours of print, its letters letters, as small as it can be."""

from __future__ import annotations

import io
import re

from matplotlib import rc_context
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from ..views.picture import Picture
from .artists import draw_picture, theme_style

POINTS = 72
"""Of an inch, as SVG counts."""
LETTER = 11
"""Points; the letters of an axis are lower where its label is too long, each being about half as wide as high."""
NAMELESS = {"Date": None, "Creator": None, "Format": None, "Type": None}
FAMILY = "DejaVu Sans, Verdana, sans-serif"
"""The letters of a picture, and others as wide where these are not installed."""
_TAG = re.compile(r"<[^>]*>")
_LONG = re.compile(r"-?\d+\.\d{3,}")


def printed(picture: Picture, width: float, height: float) -> str:
    """``picture`` as an SVG of so many inches; its letters are those of the theme, 11 points high."""
    with rc_context(theme_style("print") | {"svg.fonttype": "none", "svg.hashsalt": "camkit"}):
        figure = Figure(figsize=(width, height), dpi=POINTS, layout="constrained")
        FigureCanvasAgg(figure)
        draw_picture(picture, axes := figure.add_subplot(), "print")
        for label, room in ((axes.xaxis.label, width), (axes.yaxis.label, height)):
            label.set_fontsize(min(LETTER, 1.3 * POINTS * room / len(label.get_text() or " ")))
        out = io.StringIO()
        figure.savefig(out, format="svg", metadata=NAMELESS, transparent=True)
    drawn = re.sub(r"<\?xml.*?<svg", "<svg", out.getvalue(), count=1, flags=re.DOTALL)
    drawn = re.sub(r"<metadata>.*?</metadata>\s*", "", drawn, flags=re.DOTALL)
    return _TAG.sub(lambda tag: _short(tag[0]), drawn)


def _short(tag: str) -> str:
    """An element with places to a hundredth of a point."""
    return _LONG.sub(lambda number: f"{float(number[0]):.2f}", tag).replace("'DejaVu Sans'", FAMILY)
