"""Views of a cam with an elastic train: how it moves, its force beside a rigid one's, over speed, and in flight.

They show whatever analysis offers a ``response``, ``over_speed``, ``flight`` and ``train_bodies`` (see
`camkit.dynamics.ElasticFollower`).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Protocol, Unpack

import numpy as np

from ..geometry import Body
from ..quantities.types import Array, Value
from ..units import deg, mm, rpm, um
from .cam import ANGLE, bodies, position
from .picture import Area, Axes, Band, LabelStyle, Line, Mark, Picture, Points, Text, gaps, in_lines

FORMAL = "formal: the follower leaves the cam, see gap"
OTHER = "the other flank of the groove leads"
MOST_DRAWN = 1440
"""Samples of a turn that are drawn, about."""
NUMBERED = 6
"""So many harmonics, the fastest, have their number written."""
FEWEST, MOST = 12, 60
"""So many harmonics are shown at least and at most."""
FLOOR = 1e-6
"""The spectrum ends at such a share of the largest harmonic."""


class AtSpeed(Protocol):
    """The analysis of a cam with an elastic train."""

    @property
    def cam_angle(self) -> Array: ...
    @property
    def rocks(self) -> bool: ...
    @property
    def train_bodies(self) -> tuple[Body, ...]: ...
    @property
    def exaggeration(self) -> float: ...
    @property
    def response(self) -> Any: ...
    @property
    def load_acceleration(self) -> Array: ...
    @property
    def over_speed(self) -> Any: ...
    @property
    def harmonics(self) -> Array: ...
    @property
    def surge_frequency(self) -> Value: ...
    @property
    def flight(self) -> Any: ...
    @property
    def form_closed(self) -> Value: ...


def cam_and_train(analysis: AtSpeed, turn: float = 0.0) -> Picture:
    """Cam, follower and train with the cam turned by ``turn`` (rad): the spring gives way, the follower may fly.

    To scale but for what the train deflects and how far the follower is off the cam: by a factor that is said.
    """
    factor = analysis.exaggeration
    what = "deflection and gap" if analysis.flight else "deflection"
    title = f"Cam and train  ({what} × {factor:.6g})"
    axes = Axes(title=title, xlabel="x  [mm]", ylabel="y  [mm]", equal=True)
    return Picture.of(axes, bodies(analysis.train_bodies, position(analysis.cam_angle, turn)))


def _rated(analysis: AtSpeed) -> bool:
    """Whether speeds are shares of a rated one that nobody knows."""
    return bool(getattr(analysis, "rated", False))


def _speeds(analysis: AtSpeed) -> tuple[str, float]:
    """The unit in which speeds of the cam are shown, and its size."""
    return ("% of rated", 0.01) if _rated(analysis) else ("rpm", rpm)


def _turn(response: Any, *curves: Array) -> Iterator[Array]:
    """Cam angle (deg) and curves over a whole turn, closed, in as many places as are drawn."""
    step = max(1, len(response.cam_angle) // MOST_DRAWN)
    yield np.append(response.cam_angle[::step], 2 * np.pi) / deg
    for curve in curves:
        yield np.append(curve[::step], curve[0])


def force_beside_rigid(analysis: AtSpeed) -> Picture:
    """The contact force of the elastic train beside that of a rigid one, with its largest and least values."""
    response = analysis.response
    x, elastic, rigid = _turn(response, response.contact_force, response.rigid_contact_force)
    lost = elastic < 0
    said = (OTHER if analysis.form_closed else FORMAL) if lost.any() else ""
    high, low = int(np.argmax(elastic)), int(np.argmin(elastic))
    marks: list[Mark] = [
        Line("zero", x[[0, -1]], [0.0, 0.0], role="guide"),
        Area("pull", x, np.where(lost, elastic, 0.0), 0.0 * x, role="trouble", opacity=0.25),
        Line("rigid", x, rigid, role="ghost", stroke="dashed", label="rigid"),
        Line("elastic", x, elastic, role="position", label="elastic"),
        Line("formal", x, gaps(elastic, lost), role="trouble", stroke="line"),
        Points("most", x[[high]], elastic[[high]], role="position", names=(f"largest {response.max_force:.4g} N",)),
        Points("least", x[[low]], elastic[[low]], role="trouble" if lost.any() else "position", fill="paper",
               names=(f"least {response.least_force:.4g} N" + f", {said}" * bool(said),)),
    ]  # fmt: skip
    title = f"Dynamic factor {response.dynamic_factor:.3g}" + ", formal" * (said == FORMAL)
    xlabel = f"{ANGLE}    ({response.least_force:.4g} to {response.max_force:.4g} N)"
    return Picture.of(Axes(title=title, xlabel=xlabel, ylabel="contact force  [N]"), marks)


def acceleration_beside_cam(analysis: AtSpeed) -> Picture:
    """The acceleration of the load beside that of the cam, by time."""
    response = analysis.response
    of_cam = response.driven.acceleration * response.speed**2
    x, load, cam = _turn(response, analysis.load_acceleration, of_cam)
    marks = [
        Line("zero", x[[0, -1]], [0.0, 0.0], role="guide"),
        Line("cam", x, cam, role="ghost", stroke="dashed", label="cam"),
        Line("load", x, load, role="acceleration", label="load"),
    ]
    unit = "rad/s²" if analysis.rocks else "m/s²"
    unit = "by rated speed squared" if _rated(analysis) else unit
    return Picture.of(Axes(title="Acceleration of the load", xlabel=ANGLE, ylabel=f"[{unit}]"), marks)


def force_over_speed(analysis: AtSpeed) -> Picture:
    """Largest and least contact force over the speed of the cam, with the harmonics of the lift that hit.

    Harmonic n meets the natural frequency at its n-th part: a line there, the bolder the larger the harmonic is.
    """
    unit, size = _speeds(analysis)
    found, now = analysis.over_speed, float(analysis.response.speed[0]) / size
    x, least, leaves = found.sweep.speed / size, found.sweep.least_force, float(found.leaving) / size
    kept = (least >= 0) | analysis.form_closed
    low, high = _window(found, x, now)
    there = bool(leaves <= x[-1])
    marks: list[Mark] = [
        *_hits(analysis, high),
        Band("zero", 0.0, 0.0, role="guide"),
        Line("rigid most", x, found.rigid_max, role="ghost", stroke="dashed", label="rigid"),
        Line("rigid least", x, found.rigid_least, role="ghost", stroke="dashed"),
        Line("most", x, found.sweep.max_force, role="position", label="largest"),
        Line("least", x, gaps(least, kept), role="follower", label="least"),
        Line("formal", x, gaps(least, ~kept), role="follower", stroke="thin dotted"),
        Line("now", [now, now], [low, high], role="ink"),
        Line("leaves", *(([leaves] * 2, [low, high]) if there else ([], [])), role="limit"),
    ]
    title = f"Leaves at {leaves:.4g} {unit}" if there else "Force over speed"
    xlabel = f"cam speed  [{unit}]    (thin: natural frequency / n)"
    axes = Axes(title=title, xlabel=xlabel, ylabel="contact force  [N]",
                xlim=(0.0, x[-1]), ylim=(low, high))  # fmt: skip
    return Picture.of(axes, marks)


def _window(found: Any, x: Array, now: float) -> tuple[float, float]:
    """From where to where forces are shown: what is far beyond the speed of the cam may be cut off."""
    near = x <= 1.1 * max(now, 0.8 * x[-1])
    high = 1.15 * max(np.max(found.sweep.max_force[near]), np.max(found.rigid_max[near]))
    return max(1.1 * float(np.min(found.sweep.least_force[near])), -0.35 * high), float(high)


def _hits(analysis: AtSpeed, high: float) -> Iterator[Mark]:
    """Where harmonics of the lift meet the natural frequency, by number."""
    found, force, (_, size) = analysis.over_speed, "N m" if analysis.rocks else "N", _speeds(analysis)
    places = np.array([hit.speed for hit in found.hits]) / size
    for at, hit in zip(places, found.hits, strict=True):
        yield Line(f"hit {hit.number}", [at, at], [0.0, 0.9 * high], role="velocity", stroke="thin")
    for at, hit in [*zip(places, found.hits, strict=True)][:NUMBERED]:
        yield Text(f"number {hit.number}", at, 0.95 * high, f"{hit.number}", role="velocity", size=9.5)
    told = tuple(
        f"harmonic {hit.number} of the lift, {_size(hit.amplitude, analysis.rocks)}: up to {hit.force:.3g} {force} more"
        for hit in found.hits
    )
    most = np.interp(places, found.sweep.speed / size, found.sweep.max_force)
    yield Points("hits", places, most, role="velocity", size=6, names=told)


def _size(amplitude: float, rocks: bool) -> str:
    return f"{1e3 * amplitude:.3g} mrad" if rocks else f"{amplitude / um:.3g} µm"


def spectrum_of_lift(analysis: AtSpeed) -> Picture:
    """Amplitudes of the lift's harmonics; those next to the natural and the surge frequency are marked."""
    response, lift = analysis.response, analysis.harmonics
    unit, scale, speed = "mrad" if analysis.rocks else "µm", 1e-3 if analysis.rocks else um, float(response.speed[0])
    own = {"natural frequency": response.natural_frequency, "surge of the spring": analysis.surge_frequency}
    near = {name: float(frequency) / speed for name, frequency in own.items() if np.isfinite(frequency)}
    last = int(np.clip(np.ceil(1.6 * max(near.values())), FEWEST, min(MOST, len(lift) - 1)))
    n, amplitude = np.arange(1, last + 1), lift[1 : last + 1] / scale
    floor = FLOOR * amplitude.max()
    hit = np.any([abs(n - ratio) < 1 for ratio in near.values()], axis=0)
    told = tuple(f"harmonic {k}: {a:.3g} {unit}" for k, a in zip(n, amplitude, strict=True))
    marks: list[Mark] = [
        _stems("harmonics", n, amplitude, floor, ~hit, role="position"),
        _stems("hit", n, amplitude, floor, hit, role="limit", label="next to it" if hit.any() else ""),
        *(Band(name, ratio, ratio, along="y", role=role, label=f"{name}: {ratio:.3g}")
          for (name, ratio), role in zip(near.items(), ("velocity", "jerk"), strict=False)),
        Points("tops", n, gaps(amplitude, amplitude > floor), role="position", size=4, names=told),
    ]  # fmt: skip
    axes = Axes(title="Spectrum of the lift", xlabel="harmonic of the cam's speed", ylabel=f"amplitude  [{unit}]",
                log="y", xlim=(0.0, last + 1.0), ylim=(floor, 3 * amplitude.max()))  # fmt: skip
    return Picture.of(axes, marks)


def _stems(key: str, n: Array, amplitude: Array, floor: float, where: Array, **style: Unpack[LabelStyle]) -> Line:
    there = where & (amplitude > floor)
    nothing = np.full(len(n), np.nan)
    x, y = (np.stack(part, axis=-1)[there].ravel() for part in ((n, n, nothing), (0 * n + floor, amplitude, nothing)))
    return Line(key, x, y, stroke="bold", **style)


def gap_and_strikes(analysis: AtSpeed) -> Picture:
    """How far the follower is off the cam, from rest on over two turns, and where it strikes; or that it stays on."""
    flight, speed = analysis.flight, float(analysis.response.speed[0])
    if flight is None:
        return _stays(analysis)
    unit, scale = ("deg", deg) if analysis.rocks else ("mm", mm)
    strikes = [event for event in flight.events if event.kind == "on"]
    at = np.array([event.cam_angle for event in strikes]) / deg
    told = tuple(
        f"strikes at {angle:.4g} deg" + _impulse(event, analysis.rocks)
        for angle, event in zip(at, strikes, strict=True)
    )
    x, gap = flight.cam_angle / deg, flight.gap / scale
    marks = [
        Area("off", x, 0.0 * x, gap, role="trouble", opacity=0.25),
        Line("gap", x, gap, role="limit", stroke="line", label="gap"),
        Points("strikes", at, 0.0 * at, role="trouble", mark="triangle", names=told, label="strike"),
    ]
    title = f"Gap: up to {flight.max_gap / scale:.3g} {unit}"
    title += f", strikes up to {flight.impulse:.3g} N{' m' * analysis.rocks} s" if flight.impulse > 0 else ""
    time = "" if _rated(analysis) else f"    (360 deg: {2e3 * np.pi / speed:.4g} ms)"
    xlabel = f"cam angle from rest on  [deg]{time}"
    return Picture.of(Axes(title=title, xlabel=xlabel, ylabel=f"gap  [{unit}]", xlim=(0.0, float(x[-1]))), marks)


def _impulse(event: Any, rocks: bool) -> str:
    return f", {event.impulse:.3g} N{' m' * rocks} s" if event.impulse > 0 else ""


def _stays(analysis: AtSpeed) -> Picture:
    """That there is no gap, in a sentence."""
    least = f"its least force is {analysis.response.least_force:.4g} N"
    why = "a groove holds it from both sides" if analysis.form_closed else least
    words = in_lines(f"The follower stays on the cam: {why}.", 34, 4)
    return Picture.of(
        Axes(title="Gap", bare=True, xlim=(0.0, 1.0), ylim=(0.0, 1.0)), Text("stays", 0.5, 0.5, words, size=12)
    )
