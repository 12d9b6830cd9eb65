"""A view asks of no number what it is: given values that nobody knows yet, it makes the same marks of them."""

from dataclasses import fields
from enum import Enum

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from camkit import DoorHandleCam, HighSpeedCam, OscillatingFlatCam, TranslatingRollerCam, ValveCam
from camkit.linkage import DoubleUniversalJoint
from camkit.machines import CabinDoorLinkage, CamLever
from camkit.render.positions import positions_of
from camkit.views import default_views
from camkit.views.picture import Mark


class Unknown(np.ndarray):
    """Numbers that can be computed with, and of which nothing can be asked."""

    def __array_ufunc__(self, ufunc, method, *inputs, **options):
        return unknown(getattr(ufunc, method)(*map(known, inputs), **{k: known(v) for k, v in options.items()}))

    def __array_function__(self, function, types, arguments, options):
        return unknown(function(*map(known, arguments), **{k: known(v) for k, v in options.items()}))

    def _asked(self, *_):
        raise TypeError("nobody knows that value yet")

    __bool__ = __float__ = __int__ = __index__ = _asked

    def __format__(self, spec):
        return format(known(self)[()], spec)

    def __getitem__(self, at):
        return unknown(known(self)[known(at)])


def known(value):
    """What it stands for."""
    if isinstance(value, Unknown):
        return value.view(np.ndarray)
    if isinstance(value, Part):
        return object.__getattribute__(value, "real")
    return type(value)(map(known, value)) if type(value) in (list, tuple) else value


def unknown(value):
    """The same of unknown numbers; what says how many or which of several there are stays known."""
    if isinstance(value, float | np.ndarray | np.generic):
        return np.asarray(value).view(Unknown)
    if isinstance(value, dict):
        return {key: unknown(each) for key, each in value.items()}
    if isinstance(value, tuple):
        return type(value)(*map(unknown, value)) if hasattr(value, "_fields") else tuple(map(unknown, value))
    if type(value).__module__.startswith("camkit.") and not isinstance(value, Enum):  # a choice is known
        return Part(value)
    return (lambda *given, **named: unknown(value(*map(known, given), **named))) if callable(value) else value


class Part:
    """A part of an analysis, all of whose numbers are unknown."""

    def __init__(self, real):
        object.__setattr__(self, "real", real)

    @property
    def __class__(self):
        return type(object.__getattribute__(self, "real"))

    def __getattr__(self, name):
        return unknown(getattr(object.__getattribute__(self, "real"), name))

    def __eq__(self, other):
        return known(self) == known(other)

    __hash__ = None


DESIGNS = (
    TranslatingRollerCam(),
    OscillatingFlatCam(),
    DoorHandleCam(),
    HighSpeedCam(),
    CamLever(),
    ValveCam(),
    CabinDoorLinkage(),
    DoubleUniversalJoint(),
)
CASES = [(design, view) for design in DESIGNS for view in default_views(design.analyse(91))]


@pytest.mark.parametrize(("design", "view"), CASES, ids=lambda thing: getattr(thing, "__name__", type(thing).__name__))
def test_a_view_asks_of_no_number_what_it_is(design, view):
    analysis = design.analyse(91)
    turn = {"turn": 0.6} if "turn" in positions_of(view) else {}
    expected, made = view(analysis, **turn), view(Part(analysis), **unknown(turn))
    assert [mark.key for mark in made.marks] == [mark.key for mark in expected.marks]
    for one, other in zip(made.marks, expected.marks, strict=True):
        same(one, other)


def same(one: Mark, other: Mark) -> None:
    for field in fields(other):
        assert_array_equal(
            known(getattr(one, field.name)), getattr(other, field.name), err_msg=f"{other.key}.{field.name}"
        )


def test_a_question_would_be_noticed():
    width = unknown(2.0)
    for question in (bool, float, int, lambda w: w > 1 or w, lambda w: [1, 2, 3][w]):
        with pytest.raises(TypeError, match=r"nobody knows that value yet|must be integers"):
            question(width)
    assert known(np.where(width > 1, width, 0.0)) == 2.0
