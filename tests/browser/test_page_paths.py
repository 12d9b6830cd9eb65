"""Paths of the page's pictures: points that nobody can tell from a straight line are left out."""

from pathlib import Path

import numpy as np
import pytest

import camkit.render

SOURCE = Path(camkit.render.__file__).parent / "page/marks.js"
TRACE = """async ([source, x, y]) => {
    const { trace } = await import(URL.createObjectURL(new Blob([source], {type: "text/javascript"})));
    const parts = [], pen = {
        beginPath() {}, moveTo(...p) { parts.push([p]); }, lineTo(...p) { parts.at(-1).push(p); },
    };
    const numbers = (values) => values.map((v) => v ?? NaN);
    trace({ pen, x: (v) => v, y: (v) => v }, numbers(x), numbers(y));
    return parts; }"""
SEEN = 0.2  # pixels


@pytest.fixture(scope="module")
def page(browser):
    page = browser.new_page()
    yield page
    page.close()


def traced(page, x, y):
    """The parts of a path through points in pixels."""
    lists = [[None if np.isnan(v) else float(v) for v in values] for values in (x, y)]
    parts = page.evaluate(TRACE, [SOURCE.read_text(encoding="utf-8"), *lists])
    return [np.array(part) for part in parts]


def away(points, path):
    """How far each point is from a path."""
    a, b = path[:-1, None], path[1:, None]
    along = ((points - a) * (b - a)).sum(-1) / np.maximum(((b - a) ** 2).sum(-1), 1e-12)
    return np.hypot(*np.moveaxis(points - a - np.clip(along, 0, 1)[..., None] * (b - a), -1, 0)).min(axis=0)


T = np.linspace(0, 1, 721)
RNG = np.random.default_rng(4)
CURVES = {
    "a circle": (150 * np.cos(2 * np.pi * T), 150 * np.sin(2 * np.pi * T)),
    "a wave": (280 * T, 40 * np.sin(20 * T)),
    "a step": (280 * T, np.where(T < 0.5, 0.0, 80.0)),
    "there and back": (60 * np.sin(9 * T), 30 * np.sin(9 * T)),
    "a peak between two points": (280 * T, 50 * np.exp(-(((T - 0.4) / 0.001) ** 2))),
    "many turns": (np.cumsum(RNG.normal(size=721)), np.cumsum(RNG.normal(size=721))),
}


@pytest.mark.parametrize("name", CURVES)
def test_every_point_is_near_the_path_that_is_drawn(page, name):
    points = np.transpose(CURVES[name])
    (path,) = traced(page, *CURVES[name])
    assert away(points, path).max() < SEEN
    assert away(path, points).max() < 1e-9  # nothing is drawn that is no point
    assert (path[0] == points[0]).all()
    assert (path[-1] == points[-1]).all()


def test_a_curve_of_many_points_is_drawn_through_few(page):
    for name in ("a circle", "a wave", "there and back"):
        (path,) = traced(page, *CURVES[name])
        assert len(path) < 120


def test_what_is_no_number_parts_a_path(page):
    x, y = np.arange(9.0), np.array([0, 1, 2, np.nan, 5, np.nan, np.nan, 7, 3])
    parts = traced(page, x, y)
    assert [part.tolist() for part in parts] == [[[0, 0], [2, 2]], [[4, 5]], [[7, 7], [8, 3]]]
