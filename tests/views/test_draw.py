"""The renderer: a picture is drawn once and moved afterwards, with one rule for legends and one table of roles."""

import numpy as np
import pytest
from matplotlib import rc_context
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from numpy.testing import assert_allclose

from camkit.render.draw import ROLES as LOOKS
from camkit.render.draw import artist_of, colour, draw_picture, moving, theme_style
from camkit.views.picture import (
    ROLES,
    Area,
    Axes,
    Band,
    Circle,
    Line,
    Picture,
    Points,
    Polygon,
    Text,
)

HERE, FAR = np.array([0.0, 1.0, 2.0]), np.array([3.0, 5.0, 4.0])


def every_kind(shift=0.0, words="here"):
    return Picture.of(
        Axes(title="Title", xlabel="x", ylabel="y"),
        Band("band", 1 + shift, 2 + shift, role="allowed", opacity=0.2),
        Area("area", HERE, 0 * HERE + shift, FAR, role="ghost"),
        Polygon("solid", HERE + shift, FAR, role="body"),
        [Line("line", HERE + shift, FAR, role="profile", label="line"), Points("points", HERE, FAR + shift)],
        Circle("circle", 1 + shift, 2, 3, role="follower"),
        Text("text", 1, 2 + shift, words, anchor="left top"),
    )


@pytest.fixture
def ax():
    return Figure().add_subplot()


def test_the_second_time_marks_move(ax):
    draw_picture(every_kind(), ax)
    first = moving(ax)
    draw_picture(every_kind(0.5, "there"), ax)
    assert moving(ax) == first
    assert_allclose(artist_of(ax, "line").get_xdata(), HERE + 0.5)
    assert_allclose(artist_of(ax, "points").get_ydata(), FAR + 0.5)
    assert_allclose(artist_of(ax, "solid").get_xy()[:3], np.transpose([HERE + 0.5, FAR]))
    assert_allclose(artist_of(ax, "area").get_xy()[:3], np.transpose([HERE, [0.5] * 3]))
    assert sorted({y for _, y in artist_of(ax, "band").get_xy()}) == [1.5, 2.5]
    assert artist_of(ax, "text").get_text() == "there"
    x, y = artist_of(ax, "circle").get_data()
    assert_allclose(np.hypot(x - 1.5, y - 2), 3)


def test_what_is_gone_disappears_and_what_is_new_appears(ax):
    draw_picture(Picture.of(Axes(), Points("a", 1, 1), Points("b", 2, 2)), ax)
    draw_picture(Picture.of(Axes(), Points("c", 3, 3), Points("b", 2, 2)), ax)
    assert [artist.get_gid() for artist in moving(ax)] == ["c", "b"]


def test_marks_lie_above_each_other_in_their_order(ax):
    shown = every_kind()
    draw_picture(shown, ax)
    assert [artist.get_gid() for artist in moving(ax)] == [mark.key for mark in shown.marks]
    draw_picture(Picture(shown.axes, shown.marks[::-1]), ax)
    assert [artist.get_gid() for artist in moving(ax)] == [mark.key for mark in shown.marks[::-1]]


def test_a_role_may_change(ax):
    for role in ("ink", "trouble"):
        draw_picture(Picture.of(Axes(), Line("line", HERE, FAR, role=role)), ax)
        assert to_hex(artist_of(ax, "line").get_color()) == colour(role).lower()


@pytest.mark.parametrize("theme", ["light", "dark", "print"])
def test_every_role_has_a_look_in_every_theme(ax, theme):
    assert set(LOOKS) == set(ROLES)
    for role in ROLES:
        draw_picture(Picture.of(Axes(), Line("line", HERE, FAR, role=role)), ax, theme)
        assert to_hex(artist_of(ax, "line").get_color()) == to_hex(colour(role, theme=theme))


def names(ax):
    return [text.get_text() for text in ax.get_legend().get_texts()]


def test_the_legend_names_each_label_once_in_order_and_follows_changes(ax):
    def lines(*labels):
        return Picture.of(Axes(), [Line(f"{i}", HERE, FAR, label=label) for i, label in enumerate(labels)])

    draw_picture(lines("b", "", "a", "b"), ax)
    assert names(ax) == ["b", "a"]
    legend = ax.get_legend()
    draw_picture(lines("b", "", "a", "b"), ax)
    assert ax.get_legend() is legend
    draw_picture(lines("c", ""), ax)
    assert names(ax) == ["c"]
    draw_picture(lines("", ""), ax)
    assert ax.get_legend() is None


def test_a_short_legend_stands_beside_the_title_a_long_one_below():
    def heights(label):
        with rc_context(theme_style()):
            figure = Figure(figsize=(4, 3), dpi=100, layout="constrained")
            ax = figure.add_subplot()
            draw_picture(Picture.of(Axes(title="Many letters too"), Line("a", HERE, FAR, label=label)), ax)
            figure.draw_without_rendering()
        box = ax.get_legend().get_window_extent()
        assert box.x0 > 0
        assert box.x1 <= 405
        return box.y0, ax.get_window_extent()

    low, axes = heights("short")
    assert low > axes.y1 - 2
    low, axes = heights("many letters " * 3)
    assert low < axes.y0 - 20


def test_words_between_dollars_are_no_formula(ax):
    draw_picture(Picture.of(Axes(title="5 $ or 6 $"), Text("text", 0, 0, "1 $ to 2 $")), ax)
    assert ax.get_title(loc="left") == r"5 \$ or 6 \$"
    assert artist_of(ax, "text").get_text() == r"1 \$ to 2 \$"


def test_axes_take_scale_window_and_names_of_ticks(ax):
    named = {1.0: "one", 10.0: "ten"}
    draw_picture(Picture.of(Axes(log="x", xlim=(1, 100), xticks=named, ylim=(0, None)), Line("a", FAR, FAR)), ax)
    assert ax.get_xscale() == "log"
    assert ax.get_xlim() == (1, 100)
    assert ax.get_ylim()[0] == 0
    assert [tick.get_text() for tick in ax.get_xticklabels()] == ["one", "ten"]


def test_two_marks_with_one_key_and_roles_that_are_none_are_refused():
    with pytest.raises(ValueError, match="two marks of a picture have the key 'a'; each needs its own"):
        Picture.of(Axes(), Points("a", 1, 1), Points("a", 2, 2))
    with pytest.raises(ValueError, match="the mark 'a' has the role 'red'; it must be one of"):
        Picture.of(Axes(), Points("a", 1, 1, role="red"))
