"""What is wrong with a design, in sentences, before it is made."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...cam.flank import flanks
from ...cam.undercut import undercut_in_words
from ...quantities import Measure
from ...quantities.kinds import refuse_arguments
from ...study.limits import keeps
from ...study.robust import RobustStudy
from ...study.spread import Source
from ...study.study import Study
from ...units import deg, mm
from .blank import Blank
from .subject import Subject, analysis_of, design_of, kept, subjects
from .title import TitleBlock

YIELD = 0.99
"""Share of the parts that has to keep every limit, where nobody says another."""
MET = 1e-9
"""So near to each other (m) the ends of a closed curve meet."""


class Verdict(NamedTuple):
    """What becomes of a limit: a measure, its value (SI), ``"at most 45 deg"``, whether it is kept, by how much not."""

    measure: Measure
    value: float
    bound: str
    kept: bool
    missed: float = 0.0

    def __str__(self) -> str:
        name, known = self.measure.name, np.isfinite(self.value)
        return f"the {name} is {self.measure.text(self.value)}" if known else f"there is no {name}"


def faults(
    cam: object,
    study: Study | None = None,
    tolerances: Mapping[str | Source, object] | None = None,
    least_yield: float = YIELD,
    blank: Blank | None = None,
) -> tuple[str, ...]:
    """What is wrong with a design (or with that of an analysis or a panel), in sentences; nothing: it can be made.

    That is what the tool cuts away, walls of a groove that merge, a plate whose profile stays open, a follower that is
    struck, a bore that reaches the profile; the limits of the ``study`` that are missed, and, where there are
    ``tolerances`` (half widths by path, SI; by default those of the study), a yield below ``least_yield``.

    >>> from camkit import DoorHandleCam, TranslatingRollerCam
    >>> faults(TranslatingRollerCam())
    ()
    >>> for fault in faults(DoorHandleCam()):
    ...     print(fault)
    relief groove undercut at 20.6 to 26.1 deg: roller 5 mm, concave radius 2.67 mm
    """
    refuse_arguments(faults, locals())
    design = design_of(cam)
    analysis = analysis_of(design)
    parts = subjects(design) if has_profile(analysis) else ()
    told = [*_geometry(analysis, parts)]
    told += _reached(parts, blank) if blank else ()
    if study is not None:
        study = study.around(design)
        told += (f"{each}; it must be {each.bound}" for each in verdicts(study.nominal) if not each.kept)
        told += _yield(study, tolerances, least_yield)
    return tuple(told)


def marked(title: TitleBlock, cam: object) -> TitleBlock:
    """``title`` with what the tool cuts away of the cam, if anything: no file goes to a workshop without."""
    found = filter(None, map(lost, subjects(cam)))
    return replace(title, faults=tuple(dict.fromkeys((*title.faults, *found))))


@kept
def lost(cam: Subject) -> str:
    """What the tool cuts away of a cam, in a sentence; empty: nothing."""
    words = undercut_in_words(cam.analysis, flanks(cam.analysis).cuts)
    return f"{cam.name}: {words}" if cam.name and words else words


def has_profile(analysis: object) -> bool:
    """Whether there is a cam in it: its own profile, or that of each of several."""
    curves: Mapping[str, object] = getattr(analysis, "curves", {})
    return hasattr(analysis, "profile") or any(hasattr(part, "profile") for part in curves.values())


def _geometry(analysis: object, parts: tuple[Subject, ...]) -> Iterator[str]:
    """What cannot be cut, does not close, strikes or jams."""
    cuts = [cut for part in parts for cut in flanks(part.analysis).cuts]
    lost = getattr(analysis, "trouble", "") or (undercut_in_words(analysis, cuts) if parts else "")
    if lost:
        yield str(lost)
    for part in parts:
        whose = f"of the {part.name} " if part.name else ""
        if _open(part):
            span = np.ptp(part.analysis.profile_angle) / deg
            yield f"the profile {whose}is open: the motion covers {span:.6g} deg; a return and a dwell close the turn"
        if np.any(getattr(part.analysis, "struck", False)):
            yield f"the follower {whose}is struck by a force without end at {_corners(part)} deg, where its speed jumps"


def _corners(part: Subject) -> str:
    """The cam angles at which the follower's speed jumps most, upwards and downwards."""
    found = (part.analysis.corner(way) for way in (1, -1))
    return " and ".join(f"{angle:.4g}" for angle in sorted({at / deg for size, at in found if size > 0}))


def _open(part: Subject) -> bool:
    """Whether it is a plate whose profile does not come back to where it begins; a groove has ends of its own."""
    profile, period = part.analysis.profile, getattr(part.analysis, "period", np.zeros(2))
    if np.isfinite(part.analysis.outer_profile).all():
        return False
    gap = profile[:, -1] - profile[:, 0]
    return bool(min(np.hypot(*(gap - turn * period)) for turn in (0, 1, -1)) > MET)


def _reached(parts: Iterable[Subject], blank: Blank) -> Iterator[str]:
    """Where bore, keyway or hub reach the cam's profile, or a groove goes through the cam."""
    for part in parts:
        if part.drum:
            continue  # of a drum, which is drawn unrolled, the profile is not around the axis
        least = float(np.hypot(*part.analysis.profile).min())
        if blank.reach / 2 >= least:
            yield (
                f"the bore with its keyway reaches {blank.reach / 2 / mm:.4g} mm from the axis; the profile comes as "
                f"near as {least / mm:.4g} mm"
            )
        if np.isfinite(part.analysis.outer_profile).all() and blank.groove_depth >= blank.thickness:
            yield (
                f"the groove depth is {blank.groove_depth / mm:.4g} mm; it must be below the thickness, "
                f"{blank.thickness / mm:.4g} mm"
            )


def verdicts(study: Study) -> Iterator[Verdict]:
    """What the start of a study makes of each limit."""
    return judged(study.analysis_of(study.start), study.limits)


def judged(analysis: object, limits: Iterable[tuple[Measure, float, int]]) -> Iterator[Verdict]:
    """What an analysis makes of limits, each a measure, a value (SI), and +1 for at most or -1 for at least."""
    for measure, limit, sense in limits:
        value, sign = measure.one(analysis), measure.sign
        bound = f"at {'most' if sign * sense > 0 else 'least'} {measure.text(sign * limit)}"
        kept = bool(keeps(value, limit, sense))
        yield Verdict(measure if sign > 0 else -measure, sign * value, bound, kept, 0.0 if kept else abs(value - limit))


def _yield(study: Study, tolerances: Mapping[str | Source, object] | None, least: float) -> Iterator[str]:
    """Whether enough of the parts made after the start of a study keep its limits."""
    robust = study.under(tolerances, least) if tolerances else study
    if not isinstance(robust, RobustStudy) or not study.limits:
        return
    found = robust.recheck(robust.x0[None])
    if found.share[0] < robust.wanted:
        yield (
            f"the yield is {100 * found.share[0]:.1f} %; it must be at least {100 * robust.wanted:.4g} % "
            f"({found.missed[0]} of {found.parts[0]} parts miss a limit)"
        )
