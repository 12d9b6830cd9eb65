"""Many views in one figure: none is drawn over another."""

from itertools import combinations

import pytest

from camkit import TranslatingRollerCam, picture
from camkit.dynamics import ElasticFollower, ElasticTrain
from camkit.render import layout


def apart(axes):
    """Whether no two axes, with titles, labels and legends, meet; to a pixel."""
    boxes = [ax.get_tightbbox(ax.figure.canvas.get_renderer()).padded(-1) for ax in axes]
    return not any(one.overlaps(other) for one, other in combinations(boxes, 2))


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("many", [2, 8, 9, 10])
def test_views_have_room_for_titles_and_labels(many):
    figure, axes = layout([None] * many)
    for ax in axes:
        ax.set(title="Views beside each other", xlabel="cam angle  [deg]", ylabel="contact force  [N]")
    figure.canvas.draw()
    assert len(axes) == many
    assert apart(axes)
    assert min(ax.get_position().height * figure.bbox.height for ax in axes) > 100


@pytest.mark.filterwarnings("error")
def test_the_views_of_an_elastic_follower_have_room():
    figure = picture(ElasticFollower(TranslatingRollerCam(), ElasticTrain()))
    figure.canvas.draw()
    assert len(figure.axes) == 8
    assert apart(figure.axes)
    inside = [ax.get_position() for ax in figure.axes]
    assert min(box.width * figure.bbox.width for box in inside) > 200
    assert min(box.height * figure.bbox.height for box in inside) > 100


def test_a_height_that_was_asked_for_is_kept():
    assert layout([None] * 10, height=5.0)[0].get_figheight() == 5.0
    assert layout([None] * 7)[0].get_figheight() == 7.0 < layout([None] * 10)[0].get_figheight()
