"""What a person pulls at, a peak of a curve or a chip of the verdict, takes the free sliders along."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ...quantities import Measure, quantities_of, value_of
from ...quantities.kinds import shown
from ...search.goal_seek import goal_seek
from ...search.minimum import Minimum
from ...study.study import Study

if TYPE_CHECKING:
    from ..instrument import Instrument


def pull(app: Instrument, name: object, value: float) -> None:
    """`seek` for the page, which asks again when it has been answered."""
    try:
        seek(app, name, value)
    finally:
        app.send({"sought": name})


def seek(app: Instrument, name: object, value: float) -> Minimum[Any]:
    """Show the design nearest to that in the sliders whose measure of that name has ``value`` (SI), or comes near it.

    A limit that is missed already must not be missed by more.  ``ValueError`` for a name that no measure has.
    """
    named = {measure.name: measure for measure in app.measures}
    if not isinstance(name, str) or name not in named:
        raise ValueError(f"there is no measure {shown(name)} here")
    measure = named[name]
    study = Study(app.design, _space(app), (measure,), _eased(app, "at_most", 1), _eased(app, "at_least", -1))
    found = goal_seek(study, value)
    app.load(found.design)
    if abs(found.f - value) > 1e-5 * max(abs(value), abs(found.f)):
        app.message = found.message
    return found


def _eased(app: Instrument, kind: str, sense: int) -> dict[Measure, float]:
    """Limits of a kind; one that is missed is where its measure stands."""
    known = (app.limits[kind] or {}).items()
    now = {measure: sense * measure.one(app.analysis) for measure, _ in known}
    return {m: sense * max(sense * v, now[m]) if np.isfinite(now[m]) else v for m, v in known}


def _space(app: Instrument) -> Mapping[str, tuple[float, float]]:
    """The free sliders, from end to end; one that stands beyond its end reaches as far as it stands."""
    space = {}
    for (path, declared), row in zip(quantities_of(app.design).items(), app.structure["quantities"], strict=True):
        now = float(value_of(app.design, path))
        if row["free"]:
            space[path] = min(declared.low * declared.factor, now), max(declared.high * declared.factor, now)
    return space
