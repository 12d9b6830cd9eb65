"""Measures of a valve cam, and the questions asked of it: the paper's, and the ones it was after.

Source: He Zhenjun, Li Xuefeng, Mech. Sci. Technol. Aerosp. Eng. 27(10) 2008, 1141-1144.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..cam.follower_measures import jump_margin, leaving_speed
from ..cam.measures import max_pressure_angle, over_cam, peak_force
from ..cam.timing import at_lift
from ..quantities import Measure
from ..quantities.kinds import listed, refuse_arguments
from ..study.study import Space, Study
from ..study.weighted import WeightedSum, weighted
from ..units import deg, mm
from .valve_analysis import ValveAnalysis
from .valve_cam import ValveCam

fullness = Measure("fullness", "", lambda a: a.fullness)
nose_acceleration = Measure("nose acceleration", "m/s^2", lambda a: a.nose_acceleration)
nose_deceleration = Measure("nose deceleration", "m/s^2", lambda a: abs(a.nose_acceleration))
peak_acceleration = Measure("peak positive acceleration", "m/s^2", lambda a: a.peak_acceleration)
nose_radius = Measure("radius at the nose (flat follower)", "mm", lambda a: a.nose_radius)
min_radius = Measure("minimum convex radius of curvature", "mm", lambda a: a.profile_margin.value)
min_concave_radius = Measure("minimum concave radius of curvature", "mm", lambda a: a.min_concave_radius)
face_reach = over_cam("reach of the contact on a flat face", "mm", lambda a: abs(a.velocity))
peak_stress = over_cam("peak contact stress", "MPa", lambda a: a.contact_stress)
peak_camshaft_torque = over_cam("peak camshaft torque", "N m", lambda a: abs(a.cam_torque))
VALVE_MEASURES = (
    fullness,
    nose_acceleration,
    peak_acceleration,
    nose_radius,
    min_radius,
    min_concave_radius,
    max_pressure_angle,
    face_reach,
    leaving_speed,
    peak_force,
    peak_stress,
    peak_camshaft_torque,
)
"""What a table of a valve cam shows; peaks are those of the opening flank, which the closing one mirrors."""

PAPER_BOX = {"n": (3.0, 20.0), "m": (1.0, 20.0)}
"""The paper's ranges of the exponents' parameters."""
PAPER_MIN_RADIUS = 4.5 * mm
"""The paper's limit for the radius of curvature."""
STUDY_ANGLES = 91
"""Cam angles of an analysis within a search: peaks are looked for again between them, and right to 1e-7."""

listed_deceleration = Measure("nose deceleration as listed", "", lambda a: abs(a.nose_acceleration) / mm * deg**2)
"""In the units of the paper's listing: mm and seconds, but the half angle in degrees."""


def in_paper_units(cam: ValveCam) -> ValveCam:
    """The cam that the paper's listing computes: it takes ``v = v_g alpha_B / omega`` in m/s and degrees for mm.

    That is a seating velocity of 0.0573 of the stated one.

    >>> cam = in_paper_units(ValveCam())
    >>> print(f"{cam.seating_slope * cam.half_angle / mm:.7f} mm")
    0.0657840 mm
    """
    refuse_arguments(in_paper_units, locals())
    return cam.replace(seating_velocity=cam.seating_velocity * mm / deg)


LOWER, UPPER = 0, 1
"""Ends of the paper's ranges, and corners of its box."""


def corner(cam: ValveCam, end: int) -> ValveAnalysis:
    """The cam at the lower or upper corner of the paper's box: where the normalisers ``K1`` and ``K2`` come from."""
    analysis: ValveAnalysis = cam.replace(**{name: bounds[end] for name, bounds in PAPER_BOX.items()}).analyse()
    return analysis


def _share(measure: Measure, end: int) -> Measure:
    """A measure over its largest value in the paper's box, which it has at a corner."""
    return Measure(f"{measure.name} / largest in the box", "", lambda a: measure(a) / measure(corner(a.cam, end)))


def _listed(measure: Measure) -> Measure:
    """A measure of the cam that the paper's listing computes (see `in_paper_units`)."""
    return Measure(f"{measure.name}, listed", measure.unit, lambda a: measure(in_paper_units(a.cam).analyse()))


fullness_share, deceleration_share = _share(fullness, UPPER), _share(nose_deceleration, LOWER)
acceleration_share = _share(peak_acceleration, UPPER)
AS_STATED = fullness_share, deceleration_share, nose_radius
AS_LISTED = tuple(_listed(measure) for measure in AS_STATED)
"""What the paper weighs and limits, as it states it and as its listing computes it."""
ValveCam.measures = (
    *VALVE_MEASURES,
    nose_deceleration,
    listed_deceleration,
    jump_margin,
    *AS_STATED[:2],
    acceleration_share,
    *AS_LISTED,
)
ValveCam.makers = {"at lift": at_lift}


def _against_fullness(name: str, full: Measure, wear: Measure, weights: Sequence[float]) -> WeightedSum:
    """``W1 (-xi / K1) + W2 (wear / K2)``: both are measured over their largest values."""
    weights = listed(weights, "the weights", "objective")
    if len(weights) != 2:
        raise ValueError(f"there are {len(weights)} weights; there must be one of the fullness and one of the wear")
    return weighted(f"fullness against {name}", dict(zip((-full, wear), weights, strict=True)), (1.0, 1.0))


def valve_study(
    start: ValveCam | None = None,
    weights: Sequence[float] = (0.5, 0.5),
    *,
    printed_sign: bool = False,
    paper_units: bool = False,
) -> Study:
    """The paper's problem: ``W1 (-xi / K1) + W2 (|a| / K2)`` small, radius at the nose at least 4.5 mm.

    ``K1`` and ``K2`` are the largest fullness and the largest nose deceleration ``|a|`` in the box, of a cam that is
    otherwise the same.  ``printed_sign`` takes ``a`` as printed, without the bars: being negative, it is then rewarded
    for its size.  ``paper_units`` measures what the paper's listing computes (see `in_paper_units`): there
    K1 = 0.637143792, K2 = 599.758.

    >>> listed = in_paper_units(ValveCam())
    >>> print(f"{fullness(corner(listed, UPPER)):.9f}, {listed_deceleration(corner(listed, LOWER)):.6f}")
    0.637143792, 599.758095
    """
    refuse_arguments(valve_study, locals())
    full, size, radius = AS_LISTED if paper_units else AS_STATED
    name = f"nose deceleration{' as listed' * paper_units}{', sign as printed' * printed_sign}"
    objective = _against_fullness(name, full, -size if printed_sign else size, weights)
    limit = {radius: PAPER_MIN_RADIUS}
    return Study(start or ValveCam(), PAPER_BOX, (objective,), at_least=limit, angles=STUDY_ANGLES)


def corrected_valve_study(start: ValveCam | None = None, weights: Sequence[float] = (0.5, 0.5)) -> Study:
    """What the paper was after: ``W1 (-xi / K1) + W2 (a+ / K2)`` small, radius at least 4.5 mm anywhere.

    ``a+`` is the peak positive acceleration, which grows with the fullness; ``K1`` and ``K2`` are both at the
    upper corner of the box.  With the paper's base radius of 21 mm no (n, m) keeps the limit, so
    no random design is feasible before the base circle is larger.

    >>> study = corrected_valve_study(ValveCam(base_radius=24.5 * mm))
    >>> study.evaluate([[20, 20], [20, 1]]).feasible.tolist()
    [True, False]
    """
    refuse_arguments(corrected_valve_study, locals())
    objective = _against_fullness(peak_acceleration.name, fullness_share, acceleration_share, weights)
    limit = {min_radius: PAPER_MIN_RADIUS}
    return Study(start or ValveCam(), PAPER_BOX, (objective,), at_least=limit, angles=STUDY_ANGLES)


def keeping_min_radius(cam: ValveCam, least: float = PAPER_MIN_RADIUS) -> ValveCam:
    """The same cam on the base circle on which its least convex radius under its follower is ``least``.

    >>> print(f"{keeping_min_radius(ValveCam(n=20, m=20)).base_radius / mm:.3f} mm")
    24.341 mm
    """
    refuse_arguments(keeping_min_radius, locals())
    return cam.replace(base_radius=float(cam.analyse().base_radius_for(least)))


def valve_front_study(
    start: ValveCam | None = None,
    limited: Measure = nose_radius,
    space: Space | None = None,
) -> Study:
    """The real conflict: much fullness against little peak positive acceleration.

    ``limited`` is the radius that the paper's limit of 4.5 mm holds for: `nose_radius` as published, or
    `min_radius`; ``space`` are other bounds than the paper's.
    """
    refuse_arguments(valve_front_study, locals())
    objectives = (-fullness, peak_acceleration)
    limit = {limited: PAPER_MIN_RADIUS}
    return Study(start or ValveCam(), space or PAPER_BOX, objectives, at_least=limit, angles=STUDY_ANGLES)
