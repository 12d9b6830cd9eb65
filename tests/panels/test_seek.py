"""The kernel's part of pulling at a chip or a peak: the free sliders follow, the others stay, limits are kept."""

import pytest
from hand import ask, at

from camkit import TranslatingRollerCam, deg, explore, mm
from camkit.cam import max_pressure_angle, min_profile_radius

FREE = ["base_radius", "roller_radius", "offset"]


def shown(angle_at_most):
    app = explore(
        TranslatingRollerCam(groove=False),
        free=FREE,
        measures=[max_pressure_angle, min_profile_radius],
        at_most={max_pressure_angle: angle_at_most},
        at_least={min_profile_radius: 5 * mm},
    )
    app.sent = []
    app.send = lambda content, buffers=(): app.sent.append(content)
    return app


def pull(app, value):
    ask(app, seek=[max_pressure_angle.name, value])
    assert app.sent == [{"sought": max_pressure_angle.name}]
    return max_pressure_angle.one(app.analysis)


def test_free_sliders_follow_and_the_others_stay():
    app = shown(30 * deg)
    before = app.design
    assert pull(app, 20 * deg) == pytest.approx(20 * deg, rel=1e-6)
    assert app.message == ""
    same = {path: getattr(before, path) for path in FREE}
    assert app.design != before
    assert app.design.replace(**same) == before
    assert at(app, "base_radius") == pytest.approx(app.design.base_radius / mm)


def test_a_limit_stops_it_in_a_sentence():
    app = shown(30 * deg)
    assert pull(app, 40 * deg) == pytest.approx(30 * deg, rel=1e-4)
    assert app.message == (
        "The maximum pressure angle cannot be 40 deg: the highest found is 30 deg; it is held by its own limit."
    )


def test_a_limit_that_is_missed_already_is_not_asked_for_but_must_not_get_worse():
    app = shown(10 * deg)
    assert max_pressure_angle.one(app.analysis) > 20 * deg
    assert pull(app, 18 * deg) == pytest.approx(18 * deg, rel=1e-6)


def test_a_name_that_no_measure_has_is_refused_and_the_page_is_answered():
    app = shown(30 * deg)
    before = app.design
    ask(app, seek=["nothing", 1.0])
    assert app.sent == [{"sought": "nothing"}]
    assert "there is no measure 'nothing' here" in app.message.lower()
    ask(app, seek=[["nothing"], 1.0])
    assert "there is no measure ['nothing'] here" in app.message.lower()
    ask(app, seek=[max_pressure_angle.name, float("nan")])
    assert "nan" in app.message
    assert app.design == before
