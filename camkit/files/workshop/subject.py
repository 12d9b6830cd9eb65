"""What is exported: the whole of one cam, or both cams of a pair, given as a design or as its analysis."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import wraps
from typing import Any, Concatenate, ParamSpec, TypeVar

import numpy as np

from ...linkage import DoubleUniversalJointAnalysis, DrivelineAnalysis, RSSRAnalysis, UniversalJointAnalysis
from ...machines.shaft_analysis import ShaftAnalysis
from ...quantities import words
from ...quantities.kinds import columns, shown
from ...quantities.types import Array
from ...study.study import Study
from ...units import in_unit
from ..decisions import Decision
from ..sessions import Session

P = ParamSpec("P")
T = TypeVar("T")
DRAWN = RSSRAnalysis, ShaftAnalysis
"""The analyses of what has no profile, but lengths in space."""
JOINTED = *DRAWN, DrivelineAnalysis, DoubleUniversalJointAnalysis, UniversalJointAnalysis
"""The analyses of what has joints; the shafts of universal joints have no lengths."""


@dataclass(frozen=True)
class Subject:
    """One cam that is to be made: its name among its machine's (empty if it is the only one), design and analysis."""

    name: str
    design: Any
    """The whole machine."""
    analysis: Any
    """Of this cam, all of it."""

    @property
    def kind(self) -> str:
        """The name of the design's class."""
        return type(self.design).__name__

    @property
    def drum(self) -> bool:
        """Whether it is a drum, which is drawn unrolled."""
        return hasattr(self.analysis, "period")

    def on_the_shaft(self, points: Array) -> Array:
        """Points of the cam's frame in that of its machine: the second cam of a pair has a frame of its own."""
        if getattr(self.design, "second", None) is not self.analysis.cam:
            return points
        return points * (np.array([[1.0], [-1.0]]) if self.design.mirrored else -1.0)

    @property
    def sense(self) -> int:
        """+1: it turns counter-clockwise as it is drawn, -1: clockwise; a drum, as seen from below, along the rise."""
        turn = np.ravel(self.analysis.turn)
        return int(np.sign(turn[-1] - turn[0]) * np.sign(np.linalg.det(self.on_the_shaft(np.eye(2)))))

    @property
    def turns(self) -> str:
        """How it turns, in words.

        >>> from camkit.cam import BarrelCam
        >>> subjects(BarrelCam())[0].turns
        'counter-clockwise as seen from below, along the rise'
        """
        way = "counter-clockwise" if self.sense > 0 else "clockwise"
        return f"{way} as seen from below, along the rise" if self.drum else way


def frame(cams: Sequence[Subject], unit: str) -> str:
    """Where the points of a drawing or a table lie, and which way the cam turns.

    >>> from camkit import TranslatingRollerCam
    >>> frame(subjects(TranslatingRollerCam()), "mm").partition("; ")[2]
    'the cam turns counter-clockwise'
    """
    first = cams[0]
    if first.drum:
        radius = in_unit(float(np.ravel(first.analysis.cam.mean_radius)[0]), unit)
        where = f"unrolled at the mean radius {radius:.6g} {unit}, seen from outside, from cam angle 0 at x = 0"
        return f"{where}; the drum turns {first.turns}"
    both = " both cams as they stand on their shaft;" if len(cams) > 1 else ""
    return f"cam axis at the origin, drawn at cam angle 0;{both} the cam turns {first.turns}"


def kept(find: Callable[Concatenate[Subject, P], T]) -> Callable[Concatenate[Subject, P], T]:
    """What is found of a cam is kept with its analysis, as a cached property is: exports ask for the same."""

    @wraps(find)
    def known(subject: Subject, /, *given: P.args, **named: P.kwargs) -> T:
        found: dict[object, T] = vars(subject.analysis).setdefault(f"_{find.__name__}", {})
        key = given, tuple(named.items())
        if key not in found:
            found[key] = find(subject, *given, **named)
        return found[key]

    return known


def subjects(given: Any) -> tuple[Subject, ...]:
    """The cams of a design, or of an analysis of it; ``ValueError`` in a sentence for what has no profile.

    >>> from camkit import TranslatingRollerCam, UniversalJointShaft
    >>> [subject.kind for subject in subjects(TranslatingRollerCam())]
    ['TranslatingRollerCam']
    >>> subjects(UniversalJointShaft())
    Traceback (most recent call last):
        ...
    ValueError: UniversalJointShaft has no cam profile; there are its joints (write_table, kind="joints"), its \
skeleton (write_dxf), its solid (write_step), a report and its JSON file
    """
    return cams_of(design_of(given), analysis_of(given))


def cams_of(design: Any, analysis: Any) -> tuple[Subject, ...]:
    """The cams of a design, or of a population, in its analysis."""
    if not hasattr(analysis, "profile"):
        parts = {name: part for name, part in getattr(analysis, "curves", {}).items() if hasattr(part, "profile")}
        if not parts:
            raise ValueError(f"{type(design).__name__} has no cam profile; {_instead(analysis)}")
        return tuple(Subject(f"{words(name)} cam", design, part) for name, part in parts.items())
    analysis = getattr(analysis, "whole", analysis)
    return (Subject("", design, analysis),)


def _instead(analysis: object) -> str:
    """What there is of a mechanism without a profile, in words."""
    joints = ('its joints (write_table, kind="joints")',) if isinstance(analysis, JOINTED) else ()
    drawn = ("its skeleton (write_dxf)", "its solid (write_step)") if isinstance(analysis, DRAWN) else ()
    return f"there are {', '.join((*joints, *drawn, 'a report and its JSON file'))}"


def analysis_of(given: Any) -> Any:
    """The analysis of one design, given itself, as the design, or as the panel, session or decision that holds it."""
    design = design_of(given)
    if isinstance(given, (Decision, Session, Study)):
        given = design
    if columns(design):
        raise ValueError(f"given is {shown(design)}, a population; one design can be exported")
    if given is not design:
        return getattr(given, "analysis", given)
    return design.analyse()


def design_of(given: Any) -> Any:
    """The design of an analysis, a panel, a session or a decision, the start of a study; a design as it is."""
    if isinstance(given, type):
        raise ValueError(f"given is {shown(given)}; one design or its analysis can be exported")
    if hasattr(given, "analyse"):
        return given
    held = (
        (getattr(given, "machine", None), getattr(given, "design", None), *vars(given).values())
        if hasattr(given, "__dict__")
        else ()
    )
    for part in held:
        if hasattr(part, "analyse") and not isinstance(part, type):
            return part
    raise ValueError(f"given is {shown(given)}; a design or its analysis can be exported")
