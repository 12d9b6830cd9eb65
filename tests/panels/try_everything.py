"""`try_everything`: move every slider, box and menu of a panel, so that a callback that fails is seen."""

from __future__ import annotations

from contextlib import ExitStack

import ipywidgets as w
from hand import at, choose, move, sliders

from camkit.panels import Instrument
from camkit.panels.kit.inputs import Check, Input, Menu, Number, Span, Typed, Whole
from camkit.panels.kit.parts import Banner
from camkit.panels.kit.sheet import Sheet
from camkit.quantities import choices_of, quantities_of, value_of


def _others(control, most):
    """Values that a control can take besides its own: a step up for a number, ``most`` options of a menu, or every."""
    if isinstance(control, Menu):
        others = [value for value in control.values if value != control.value]
        return others[:: max(1, -(-len(others) // most))] if most else others
    if isinstance(control, Check):
        return [not control.value]
    if isinstance(control, Typed):
        return ["" if control.value else "1"]
    if isinstance(control, Span):
        return _narrower(control)
    if isinstance(control, Number):
        return [control.value + (control.declared.high - control.declared.low) / 100 * control.declared.factor]
    if isinstance(control, Whole) and control.value == control.max:
        return [control.value - 1]
    return [control.value + 1]


def _narrower(band):
    """The band without its lower, then without its upper half."""
    low, high = band.value
    middle = (low + high) / 2
    return [(middle, high), (low, middle)]


def try_everything(panel, most=0):
    """Move every slider, box and menu of ``panel`` to other values and back; says how many were moved.

    A menu comes to every option, or to ``most`` from all along it.

    Raises whatever a callback raises, and ``AssertionError`` if a control did not come back or the panel says that a
    measure, a view or what follows it could not be computed.
    """
    controls = [c for c in inside(panel) if isinstance(c, Input) and not c.disabled]
    count = len(controls) + sum(_try_page(app) for app in inside(panel) if isinstance(app, Instrument))
    with ExitStack() as quiet:  # the page need not see the steps between, only where everything ends
        for held in inside(panel):
            if isinstance(held, Sheet):
                quiet.enter_context(held.held())
            elif isinstance(held, w.Widget):
                quiet.enter_context(held.hold_sync())
        for control in controls:
            before = control.value
            for value in [*_others(control, most), before]:
                _give(control, value)
                _refuse_failure(panel)
            assert control.value == before, f"{control.description or type(control).__name__} did not come back"
    return count


def _try_page(app):
    """Every slider that the page has, and another option of every menu."""
    before, paths = app.design, sliders(app)
    for path in paths:
        if path in quantities_of(app.design):
            declared, shown = quantities_of(app.design)[path], at(app, path)
            for value in (shown + (declared.high - declared.low) / 100, shown):
                move(app, path, value)
                _refuse_failure(app)
        else:
            own = value_of(app.design, path)
            other = next(name for name, option in choices_of(app.design)[path].named.items() if option != own)
            for option in (other, own):  # each is recorded anew
                choose(app, path, option)
                _refuse_failure(app)
        app.load(before)
    assert app.design == before
    return len(paths)


def _give(control, value):
    """Another value, as a person gives it."""
    if isinstance(control, Number):
        control.take({"value": value})
    else:
        control.value = value


SAYS = {Banner: "text", Instrument: "message"}
"""What tells a person in a sentence, and where it stands."""


def _refuse_failure(panel):
    """``AssertionError`` if the panel says that a measure or a view raised an error of Python."""
    for part in inside(panel):
        said = next((getattr(part, name) for kind, name in SAYS.items() if isinstance(part, kind)), "")
        assert "cannot be computed:" not in said, said
        assert "The page computes" not in said, said


def inside(box):
    """Every widget inside ``box``, and every part of a sheet."""
    if isinstance(box, Sheet):
        return [box, *box.top.inside()]
    return [box, *(c for child in getattr(box, "children", ()) for c in inside(child))]
