"""Machines of every menu, and all that is shown of them: what programs of whole machines are tried on."""

from dataclasses import fields

import numpy as np
from every_machine import MACHINES

from camkit import OscillatingRollerCam, TranslatingFlatCam, TranslatingRollerCam, deg, mm
from camkit.machines.high_speed_cam import LOADS
from camkit.motion import (
    LAW_MENU,
    FreePolynomial,
    ModifiedSine,
    ShapedLaw,
    SplineLaw,
    TableLaw,
    motion_from_table,
)
from camkit.motion.families.shaped import SPLINE
from camkit.quantities import choices_of, measures_of, with_quantities
from camkit.render.positions import positions_of
from camkit.views import default_views

U = np.linspace(0, 1, 25)
LAWS = {
    **{law.name: law for law in LAW_MENU},
    "free polynomial of degree 7": FreePolynomial((0, 0.3, 1, -2), (1, 1.5, -3, 4)),
    "B-spline of degree 7": SplineLaw((0.3, 0.6), (0.2, 0.7), (0.0, 0.0, 1.0), (0.5, 0.0, 0.0)),
    "shaped by a B-spline": ShapedLaw(ModifiedSine(), (0.05, -0.1, 0.0, 0.02), SPLINE),
    "table": TableLaw(U, np.round(U**3 * (10 - 15 * U + 6 * U**2), 3), 1e-3),
}
POSITIONS = {"turn": 1.3, "azimuth": 0.5, "elevation": 0.4}
NOT_YET = {
    ("shaft", "plane_of_sizes"): "a search and a map of the plane stand behind it, and its contours follow from them",
    ("shaft", "section"): "a catalogue is searched for what holds, and its legend names what is found",
}
"""Views that cannot be recorded, and why."""

TURN = np.arange(0.0, 360, 4)
MANY = np.arange(0.0, 360, 0.05)


def waves(angle):
    return 9 - 8 * np.cos(np.radians(angle)) + 2 * np.sin(np.radians(3 * angle))


def tables():
    """Cams whose motion is from a table: around a turn, closed by a dwell, with free ends, and of many pieces."""
    turn = motion_from_table(TURN * deg, waves(TURN) * mm, digit=1e-6)
    lobe = motion_from_table(np.arange(-70, 71) * deg, 8.5e-3 * np.cos(np.arange(-70, 71) * deg / 1.4 * 1.8) ** 4)
    free = motion_from_table(np.arange(0, 91) * deg, np.sin(np.arange(0, 91) * deg) * 12 * deg, "deg", digit=1e-9)
    many = motion_from_table(MANY * deg, (waves(MANY) + 0.02 * np.sin(np.radians(97 * MANY))) * mm, digit=1e-9)
    return {
        "table around a turn": TranslatingRollerCam(turn, 60 * mm),
        "table and dwell": TranslatingFlatCam(lobe, 40 * mm),
        "table with free ends": OscillatingRollerCam(free),
        "table of many pieces": TranslatingRollerCam(many, 80 * mm, groove=False),
    }


def designs_of_every_menu(each):
    """So many designs of each machine, with options by lot: no option comes again before all of its menu are drawn."""
    rng, drawn = np.random.default_rng(0), {}
    for name, machine in MACHINES.items():
        for k in range(max(each, len(LOADS) if name == "high speed" else 0)):
            yield f"{name} {k}", _with_menus(machine, rng, drawn)


def _with_menus(design, rng, drawn):
    chosen = set()
    while path := next((path for path in choices_of(design) if path not in chosen), None):
        options = choices_of(design)[path].options
        menu = drawn.setdefault(id(options), _by_lot([*LAWS.values()] if options is LAW_MENU else options, rng))
        design = with_quantities(design, {path: next(menu)})
        chosen.add(path)
    return design


def _by_lot(options, rng):
    while True:
        yield from (options[k] for k in rng.permutation(len(options)))


def said(name, value):
    """The numbers and texts of a part of a picture, by name."""
    if isinstance(value, dict):
        value = [*value, *value.values()]
    if isinstance(value, (list, tuple)):
        return {k: v for i, part in enumerate(value) for k, v in said(f"{name} {i}", part).items()}
    return {} if value is None or isinstance(value, bool) else {name: value}


def of_picture(picture):
    """The numbers and texts of a picture's marks and axes."""
    parts = [("axes", picture.axes), *((mark.key, mark) for mark in picture.marks)]
    values = (said(f"{key} {f.name}", getattr(part, f.name)) for key, part in parts for f in fields(part))
    return {key: value for each in values for key, value in each.items()}


def everything(design, n):
    """A function that gives the measures of a design, and the numbers and texts of its default views; its positions."""
    views = [view for view in default_views(design.analyse(n)) if view.__name__ not in {view for _, view in NOT_YET}]

    def of(design, **position):
        analysis = design.analyse(n)
        found = {measure.name: measure.of(analysis, 1) for measure in measures_of(design)}
        for view in views:
            picture = view(analysis, **{key: position[key] for key in positions_of(view) if key in position})
            found |= {f"{view.__name__}: {key}": value for key, value in of_picture(picture).items()}
        return found

    asked = {key for view in views for key in positions_of(view)}
    return of, {key: value for key, value in POSITIONS.items() if key in asked}
