"""The renderer: a picture is drawn once and moved afterwards, with one rule for legends and one table of roles."""

from itertools import combinations

import numpy as np
import pytest
from matplotlib import rc_context
from matplotlib.colors import to_hex, to_rgb
from matplotlib.figure import Figure
from numpy.testing import assert_allclose

from camkit.render.artists import artist_of, draw_picture, moving, theme_style
from camkit.render.roles import ROLES as LOOKS
from camkit.render.roles import colour, contrast, letter_colour
from camkit.views.picture import (
    ROLES,
    Area,
    Axes,
    Band,
    Circle,
    Contour,
    Line,
    Picture,
    Points,
    Polygon,
    Region,
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


def test_a_height_counts_before_the_order(ax):
    heights = {"low": -1.0, "above all": np.inf, "plain": 0.0, "first": 2.0, "second": 2.0}
    draw_picture(Picture.of(Axes(), (Points(key, 1, 1, height=h) for key, h in heights.items())), ax)
    assert [artist.get_gid() for artist in moving(ax)] == ["low", "plain", "first", "second", "above all"]


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


LINES = ("profile", "flank", "follower", "position", "velocity", "acceleration", "jerk", "limit", "allowed", "trouble")


@pytest.mark.parametrize("theme", ["light", "dark", "print"])
def test_lines_and_letters_have_the_contrast_that_wcag_asks_for(theme):
    paper = colour("paper", theme=theme)
    for role in (*LINES, "guide", "ghost", "pitch"):
        assert contrast(colour(role, theme=theme), paper) >= 3, role
    for role in set(ROLES) - {"paper", "onto"}:
        for index in range(20 if role == "series" else 1):
            assert contrast(letter_colour(role, index, theme), paper) >= 4.5, role


# Machado, Oliveira, Fernandes 2009: what is seen without the cones for green and for red, of linear light.
BLIND = {
    "deutan": [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    "protan": [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
}


def seen(shade, eyes):
    """A colour in CIELAB, as such eyes see it."""
    c = np.array(to_rgb(shade))
    linear = np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)
    linear = np.clip(np.array(BLIND.get(eyes, np.eye(3))) @ linear, 0, 1)
    xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]) @ linear
    x, y, z = np.where((r := xyz / [0.9505, 1, 1.089]) > 0.008856, np.cbrt(r), 7.787 * r + 16 / 116)
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


@pytest.mark.parametrize("theme", ["light", "dark", "print"])
@pytest.mark.parametrize("eyes", ["all cones", "deutan", "protan"])
def test_curves_differ_for_colour_blind_eyes_too(theme, eyes):
    found = {
        role: seen(colour(role, theme=theme), eyes)
        for role in ("position", "velocity", "acceleration", "jerk", "limit")
    }
    for one, other in combinations(found, 2):
        assert np.linalg.norm(found[one] - found[other]) >= 14, (one, other)


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


GRID = np.linspace(-2, 2, 81)
FIELD = np.hypot(*np.meshgrid(GRID, GRID))


def field(*names, levels=(0.5, 1.0, 1.5)):
    """A cone: its contours are circles, and a ring between two of them."""
    return Picture.of(
        Axes(xlim=(-2, 2), ylim=(-2, 2)),
        Region("ring", GRID, GRID, FIELD, 1.0, 1.5, role="allowed", label="ring"),
        Contour("circles", GRID, GRID, FIELD, levels, names=names, role="guide", label="circles"),
    )


def test_contours_are_lines_and_regions_are_outlines(ax):
    draw_picture(field(), ax)
    radius = np.hypot(*artist_of(ax, "circles").get_data())
    assert_allclose([np.nanmin(abs(radius - level)) for level in (0.5, 1.0, 1.5)], 0, atol=2e-3)
    ring = np.hypot(*artist_of(ax, "ring").get_xy().T)
    for found, levels in ((radius, [0.5, 1.0, 1.5]), (ring, [1.0, 1.5])):
        assert_allclose(abs(found[np.isfinite(found), None] - levels).min(axis=1), 0, atol=2e-3)
    assert names(ax) == ["ring", "circles"]


def test_names_stand_on_their_contours_and_go_with_them(ax):
    draw_picture(field("0.5", "1", "1.5"), ax)
    for i, level in enumerate((0.5, 1.0, 1.5)):
        name = artist_of(ax, f"circles name {i}")
        assert_allclose(np.hypot(*name.get_position()), float(name.get_text()), atol=2e-3)
        assert float(name.get_text()) == level
    draw_picture(field("9", levels=(9.0,)), ax)
    assert np.isnan(artist_of(ax, "circles").get_data()).all()
    assert [artist.get_gid() for artist in moving(ax)] == ["ring", "circles"]


def test_of_several_names_those_without_room_are_left_out_but_a_sole_one_never(ax):
    draw_picture(field("many letters " * 9, "1", "1.5"), ax)
    assert artist_of(ax, "circles name 0") is None
    assert artist_of(ax, "circles name 1").get_text() == "1"
    draw_picture(field("many letters " * 9, levels=(0.5,)), ax)
    assert artist_of(ax, "circles name 0").get_text() == "many letters " * 9


@pytest.mark.parametrize("theme", ["light", "dark", "print"])
def test_the_name_of_a_limit_is_of_ink_in_a_frame_of_its_colour(ax, theme):
    draw_picture(field("limit", levels=(1.0,)), ax, theme)
    name = artist_of(ax, "circles name 0")
    assert to_hex(name.get_color()) == colour("ink", theme=theme)
    assert to_hex(name.get_bbox_patch().get_edgecolor()) == letter_colour("guide", theme=theme)
    assert to_hex(name.get_bbox_patch().get_facecolor()) == colour("paper", theme=theme)


def test_words_change_and_are_not_shown_where_there_is_no_place(ax):
    def told(x, value):
        return Picture.of(Axes(), Text("told", x, 2.0, f"{value:.1f} mm"))

    draw_picture(told(1.0, 3.14), ax)
    assert artist_of(ax, "told").get_text() == "3.1 mm"
    draw_picture(told(np.nan, 3.14), ax)
    assert artist_of(ax, "told").get_text() == ""
    draw_picture(told(4.0, np.float64(2)), ax)
    assert (artist_of(ax, "told").get_text(), artist_of(ax, "told").get_position()) == ("2.0 mm", (4.0, 2.0))


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
