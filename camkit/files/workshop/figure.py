"""The picture of a cam to scale for a page of a report: its curves, bore and follower, without sheet and words."""

from __future__ import annotations

from ...units import mm
from .blank import Blank
from .dimensions import Words
from .layout import seen_of
from .subject import subjects
from .svg import Paper, document
from .view import SCALES, View, scale_text
from .written import length_unit

AROUND = (6.0, 12.0, 7.0, 12.0)
"""Left, right, above and below a cam, mm."""


def figure(cam: object, width: float = 160.0, height: float = 90.0, *, blank: Blank = Blank(), unit: str = "mm") -> str:
    """A cam, or both of a pair side by side, as SVG of a ``width`` and at most a ``height`` (mm), at a standard scale.

    >>> from camkit import TranslatingFlatCam
    >>> figure(TranslatingFlatCam(), 80, 60).partition("'80mm'")[2][:14]
    " height='59mm'"
    """
    words = Words(length_unit(unit))
    views = [seen_of(subject, blank, words) for subject in subjects(cam)]
    left, right, above, below = AROUND
    each = width / len(views)
    extents = [[value / mm for value in view.extent] for view in views]
    wide, high = max(e[1] - e[0] for e in extents), max(e[3] - e[2] for e in extents)
    room = each - left - right, height - above - below
    scale = next((s for s in SCALES if wide * s <= room[0] and high * s <= room[1]), SCALES[-1])
    paper = Paper(width, min(height, high * scale + above + below))
    for i, (view, (x0, x1, _, top)) in enumerate(zip(views, extents, strict=True)):
        x = i * each + left + (room[0] - (x1 - x0) * scale) / 2 - x0 * scale
        view.draw(View(paper, (x, above + top * scale), scale))
        said = ", ".join(filter(None, (view.subject.name, scale_text(scale))))
        paper.text((i * each + each / 2, paper.height - 2), said, 3.0, "middle")
    return document([paper], subjects(cam)[0].kind)
