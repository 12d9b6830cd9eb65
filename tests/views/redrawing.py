"""What tests of views share: views on axes, their marks there, and whether drawing again moves them."""

import numpy as np
from numpy.testing import assert_array_equal

from camkit.render.artists import artist_of, moving
from camkit.render.still import draw, layout

PLACE = {"Polygon": "get_xy", "Line2D": "get_data", "Text": "get_position"}


def drawn(shown, *views, **position):
    """The axes on which views show a design or an analysis; the axes themselves of one view alone."""
    _, axes = layout(views, dpi=50)
    draw(shown.analyse() if hasattr(shown, "analyse") else shown, axes, views, **position)
    return axes if len(views) > 1 else axes[0]


def xy(ax, key):
    """The points of a mark, ``(2, n)``."""
    return np.array(artist_of(ax, key).get_data(), dtype=float)


def as_drawn_anew(axes, shown, views, **position):
    """The axes hold what they would hold if the views were drawn for the first time."""
    for ax, new in zip(axes, drawn(shown, *views, **position), strict=True):
        before, after = ({a.get_gid(): a for a in moving(each)} for each in (new, ax))
        assert before.keys() == after.keys()
        for key, artist in before.items():
            place = PLACE[type(artist).__name__]
            assert_array_equal(*(np.array(getattr(a, place)(), float) for a in (after[key], artist)), err_msg=key)
        said, says = ([(t.get_gid(), t.get_text(), t.get_color()) for t in each.texts] for each in (new, ax))
        assert sorted(said) == sorted(says)
        assert ax.get_title(loc="left") == new.get_title(loc="left")


def redrawn_in_place(first, others, views, lasts=lambda artist: True, **position):
    """Drawing others and the first again makes nothing that ``lasts`` anew, and ends as it began."""
    axes = drawn(first, *views, **position)
    artists = [set(filter(lasts, moving(ax))) for ax in axes]
    for other in (*others, first):
        draw(other.analyse() if hasattr(other, "analyse") else other, axes, views, **position)
        assert [set(filter(lasts, moving(ax))) for ax in axes] == artists
    axes[0].figure.canvas.draw()
    as_drawn_anew(axes, first, views, **position)
