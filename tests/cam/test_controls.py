"""Nothing that the physics of a cam knows is without a control: every number has a path, every other thing a menu."""

import dataclasses
import enum
import importlib
import inspect
import numbers
import pkgutil

import numpy as np
import pytest
from hand import sliders
from numpy.testing import assert_allclose

import camkit.cam
from camkit import MotionProgram, Study, Tolerances, deg, explore, mm
from camkit.cam import ContactPair
from camkit.cam.directions import ROTATIONS
from camkit.cam.loads import ArmLoad
from camkit.cam.oscillating_flat import OscillatingFlatCam
from camkit.cam.oscillating_roller import OscillatingRollerCam
from camkit.cam.pair import CAMS, ConjugatePair
from camkit.cam.slide import SlideLoad
from camkit.cam.translating_flat import TranslatingFlatCam
from camkit.cam.translating_roller import TranslatingRollerCam
from camkit.files import read, write
from camkit.motion import LAW_MENU, Dwell, Return, Rise
from camkit.quantities import (
    Choice,
    Declared,
    Design,
    Quantity,
    declared_in,
    measures_of,
    quantities_of,
    value_of,
    with_quantities,
)
from camkit.views import pressure_angle

KINDS = (TranslatingRollerCam, TranslatingFlatCam, OscillatingRollerCam, OscillatingFlatCam)
SLIDE_TABLES = SlideLoad(force_table=((5 * mm, 5.0), (10 * mm, 25.0)), cam_angle_table=((1.0, 10.0), (2.0, 30.0)))
ARM_TABLES = ArmLoad(torque_table=((0.1, 5.0), (0.2, 25.0)), cam_angle_table=((1.0, 10.0), (2.0, 30.0)))

# ---------------------------------------------------------------- every field of every design

DATA = {"force_table", "torque_table", "cam_angle_table", "advance"}
"""Measured loads are data, not numbers that one chooses; their common factor is a quantity, ``table_factor``.  How far
a motion goes on with each turn is what the machine asks, and 0 for a cam."""
PLACES = {"u"}
"""Where the points of a spline's law stand: that they are in order is a property of the row, their heights are free."""
NAMES = {"name"}
"""What a segment of the motion is called is no number."""


def designs_of_the_family():
    """Every design in the modules of `camkit.cam` that can be analysed, as it is without arguments."""
    modules = (importlib.import_module(f"camkit.cam.{m.name}") for m in pkgutil.iter_modules(camkit.cam.__path__))
    found = {kind for module in modules for kind in vars(module).values() if can_be_analysed_when_made(kind)}
    return sorted((kind for kind in found if kind.__module__.startswith("camkit.cam.")), key=lambda kind: kind.__name__)


def can_be_analysed_when_made(kind):
    return isinstance(kind, type) and issubclass(kind, Design) and kind is not Design and not inspect.isabstract(kind)


def undeclared(part, where=""):
    """The fields below ``part`` that hold numbers, texts or members of an enumeration and are not declared."""
    for field in dataclasses.fields(part):
        held, path = getattr(part, field.name), f"{where}{field.name}"
        declared = isinstance(field.metadata.get("declared"), (Quantity, Choice)) or "row" in field.metadata
        if not declared and plain(held):
            yield path
        for i, below in enumerate(held if isinstance(held, tuple) else (held,)):
            if dataclasses.is_dataclass(below) and isinstance(below, Declared):
                yield from undeclared(below, f"{path}{i}.")


def plain(held):
    """Whether this is a number, a text, a member of an enumeration, or a row of such."""
    if isinstance(held, (tuple, list, np.ndarray)):
        return len(held) == 0 or any(plain(each) for each in held)
    return isinstance(held, (numbers.Number, np.generic, str, enum.Enum))


def test_the_family_is_all_there():
    assert set(designs_of_the_family()) >= set(KINDS)


def every_variant():
    for kind in designs_of_the_family():
        design = kind()
        yield design
        if "contact" in {f.name for f in dataclasses.fields(kind)}:
            yield design.replace(contact=ContactPair())
    for law in LAW_MENU:
        yield OscillatingRollerCam(up_and_down(law, 20 * deg))


def up_and_down(law, lift):
    return MotionProgram((Rise(2.0, lift, law), Dwell(1.0), Return(2.0, lift, law), Dwell(1.0)))


def test_every_field_is_a_quantity_or_a_choice_or_data():
    for design in every_variant():
        found = [path for path in undeclared(design) if path.rpartition(".")[2] not in DATA | NAMES | PLACES]
        assert found == [], type(design).__name__


def test_a_field_without_a_declaration_would_be_found():
    @dataclasses.dataclass(frozen=True)
    class Hidden(Design):
        load: SlideLoad = dataclasses.field(default_factory=SlideLoad)
        stiffness: float = 3.0

    assert list(undeclared(Hidden(load=SLIDE_TABLES))) == ["load0.force_table", "load0.cam_angle_table", "stiffness"]


# ---------------------------------------------------------------- everything that takes paths takes all of them


LAWS = {law.name: TranslatingRollerCam(up_and_down(law, 12 * mm), base_radius=60 * mm) for law in LAW_MENU}
CASES = {
    **{f"{kind.__name__}, {name}": kind(rotation=way) for kind in KINDS for name, way in ROTATIONS.items()},
    "a plate under a sliding roller": TranslatingRollerCam(groove=False),
    "a plate under a rocking roller": OscillatingRollerCam(groove=False, load=ArmLoad(spring_rate=5, preload=2)),
    "sliding knife edge": TranslatingRollerCam(roller_radius=0.0),
    "rocking knife edge": OscillatingRollerCam(roller_radius=0.0),
    **{f"pair, {cam.name}, {sigma}": ConjugatePair(cam.replace(rotation=sigma)) for cam in CAMS for sigma in (1, -1)},
    "pair with a contact": ConjugatePair(CAMS[2].replace(contact=ContactPair())),
    "tables on a slide": TranslatingRollerCam(load=SLIDE_TABLES),
    "tables on an arm": OscillatingRollerCam(load=ARM_TABLES),
    "gravity on a slide": TranslatingFlatCam(load=SlideLoad(gravity=9.81, up_angle=20 * deg)),
    "gravity on an arm": OscillatingFlatCam(load=ArmLoad(spring_rate=5, preload=9, gravity=9.81)),
    **{f"contact, {kind.__name__}": kind(contact=ContactPair(follower_material="42CrMo")) for kind in KINDS},
    **LAWS,
}
ALL_VIEWS = [
    *(CASES[f"{kind.__name__}, clockwise"] for kind in KINDS),
    *(CASES[name] for name in ("a plate under a sliding roller", "a plate under a rocking roller")),
    *(CASES[name] for name in ("sliding knife edge", "rocking knife edge", "pair with a contact")),
]
"""Those whose default views differ: drawing is what takes the time."""
every_case = pytest.mark.parametrize("design", CASES.values(), ids=CASES)


def spread(design, share=1.0713e-3):
    """Half widths of all quantities: a share of what their sliders offer."""
    return {path: share * (q.high - q.low) * q.factor for path, q in quantities_of(design).items()}


def box(design):
    """Bounds around the design, within what is possible."""
    bounds = {}
    for path, half in spread(design).items():
        value, declared = value_of(design, path), quantities_of(design)[path]
        low = value - half
        bounds[path] = (low if declared.allows(low) else value, value + half)
    return bounds


@every_case
def test_it_has_a_control_for_every_path(design):
    app = explore(design, *(() if design in ALL_VIEWS else (pressure_angle,)))
    assert set(sliders(app)) == set(declared_in(design))
    assert type(app.analysis.cam) is type(design)


@every_case
def test_a_population_over_all_its_paths_is_its_members(design):
    study = Study(design, box(design), measures_of(design)[:1], angles=61)
    low, high = study.bounds
    x = low + (high - low) * np.random.default_rng(3).random((4, len(low)))
    many = study.analysis(x)
    for i, row in enumerate(x):
        one = study.design(row).analyse(61)
        for measure in measures_of(design):
            values = np.broadcast_to(measure(many), 4)[i], measure(one)
            assert_allclose(*values, rtol=1e-12, atol=1e-12, err_msg=measure.name)


@every_case
def test_its_paths_can_be_given_tolerances(design):
    study = Study(design, box(design), measures_of(design)[:1], angles=61)
    halves = {path: (high - low) / 2 for path, (low, high) in box(design).items()}
    inside = study.replace(start=with_quantities(design, {path: sum(ends) / 2 for path, ends in box(design).items()}))
    made = Tolerances(inside, halves, parts=16)
    assert set(made.names) == set(quantities_of(design))
    assert np.isfinite(made.evaluation.f).any()


@every_case
def test_it_is_itself_when_read_from_a_file(design, tmp_path):
    write(design, tmp_path / "design.json")
    assert read(tmp_path / "design.json") == design


# ---------------------------------------------------------------- what tables are multiplied by


@pytest.mark.parametrize("load", [SLIDE_TABLES, ARM_TABLES], ids=["slide", "arm"])
def test_the_factor_of_the_tables_is_that_of_what_they_give(load):
    cam = TranslatingRollerCam() if isinstance(load, SlideLoad) else OscillatingRollerCam()
    forces = [cam.replace(load=load.replace(table_factor=k)).analyse(91).contact_force for k in (0.0, 1.0, 2.5)]
    assert_allclose(forces[2] - forces[0], 2.5 * (forces[1] - forces[0]), atol=1e-9)
    bare = type(load)(**{name: () for name in ("cam_angle_table",)})
    assert_allclose(forces[0], cam.replace(load=bare).analyse(91).contact_force, rtol=1e-12)
    assert "table_factor" in quantities_of(load)
    assert "table_factor" not in quantities_of(bare)
