"""What is shown of a cam with an elastic train: how it moves, over the speed of the cam, and in flight.

The train is a scheme: a spring behind the follower, the load's mass, and the return spring.  What it deflects is far
too little to be seen beside the cam, so it is drawn larger by a factor that the picture says.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from ..geometry import Body, Coil, Disc, Outline, rotated, vector
from ..motion import Kinematics
from ..motion.closing import TURN
from ..quantities.types import Array, Value
from .driven import bottom, top
from .flight import Flight, simulate
from .speeds import SpeedSweep, contact_loss_speed, speed_sweep
from .spring import MasslessSpring
from .steady import LEAST, Response

DRAWINGS = ("bodies", "shapes", "development")
OF_THE_CAM = ("contact_force", "pressure_angle", "curvature", "efficiency")
"""Curves of a cam that are not shown where nobody chooses: its force is, beside that of a rigid train."""
AT_SPEED = ("response", "over_speed", "flight", "load_acceleration", "harmonics")
TURNS = 2
"""Of a flight from rest, of which the last one is animated."""
SPEEDS = 200
MOST_HITS, COUNTS = 30, 0.03
"""Harmonics beyond are not looked at; one counts that adds such a share of the static force at its resonance."""
LENGTH, AHEAD = 0.45, 0.6
"""Of the train as it is drawn: over the height of the follower, and from an arm to the load on it, rad."""
SEEN = 0.4
"""The largest deflection is drawn as such a share of it, or somewhat less."""
COG = np.array([[-0.5, 0.5, 0.5, -0.5, -0.5], [0.0, 0.0, 0.5, 0.5, 0.0]])
"""A mass as it is drawn, on its foot, 1 wide."""


class Hit(NamedTuple):
    """Where a harmonic of the lift meets the natural frequency."""

    number: int
    speed: float
    """Of the cam, rad/s."""
    amplitude: float
    """m or rad."""
    force: float
    """That it adds there along the travel, ``S_n k_f^2 / (k_f + k_s) / (2 zeta)``, N or N m."""


class OverSpeed(NamedTuple):
    """An elastic train and a rigid one over speeds of the cam."""

    sweep: SpeedSweep
    rigid_max: Array
    """The largest contact force of a rigid train, N."""
    rigid_least: Array
    leaving: Value
    """The speed at which the elastic train leaves the cam, rad/s; ``nan`` where it has no damping."""
    hits: tuple[Hit, ...]
    """Of harmonics that count, the fastest first."""


class Shown:
    """An elastic analysis as it is shown; the kind of cam is its next base."""

    response: Response
    cam_angle: Array
    motion: Kinematics
    acceleration_unit: str
    form_closed: Value

    def _of_cam(self, name: str) -> Any:
        """What the cam's own analysis has."""
        return getattr(super(), name)

    @property
    def offers(self) -> tuple[Any, ...]:
        """What is shown where nobody chooses, in this order."""
        of_cam = self._of_cam("offers")
        drawn = ("train_bodies" if name == "bodies" else name for name in of_cam if name in DRAWINGS)
        rest = (name for name in of_cam if name not in (*DRAWINGS, *OF_THE_CAM))
        return (*drawn, *AT_SPEED, *rest)

    @property
    def trouble(self) -> str:
        """What is lost of the profile, and that the follower leaves the cam, in a sentence; empty if neither is."""
        lost, least = self._of_cam("trouble"), self.response.least_force
        if np.ndim(least) or not least < 0 or np.any(self.form_closed):
            return lost
        formal = (
            f"the follower leaves the cam, its least contact force would be {least:.4g} N: what is called formal is of "
            "one that stays on, the gap is of one that leaves"
        )
        return f"{lost}; {formal}" if lost else formal

    @property
    def rocks(self) -> bool:
        """Whether the follower is on an arm: its travel is then an angle."""
        return not self.acceleration_unit.startswith("mm")

    @property
    def load_acceleration(self) -> Array:
        """Of the last mass, at the response's cam angles, m/s^2 or rad/s^2."""
        return self.response.acceleration

    @property
    def harmonics(self) -> Array:
        """Amplitudes of the lift, m or rad, by number."""
        return self.response.harmonics

    @property
    def surge_frequency(self) -> Value:
        """Of the return spring, rad/s; ``nan`` of one without mass."""
        return 2 * np.pi * getattr(self.response.train.spring, "surge_frequency", np.nan)

    # ---------------------------------------------------------------- over the speed, and in flight

    @cached_property
    def leaves_at(self) -> Value:
        """The speed of the cam at which the train leaves it, rad/s."""
        return contact_loss_speed(self, self.response.train)

    @cached_property
    def over_speed(self) -> OverSpeed:
        """From well below the speed of the cam to beyond that at which the train leaves it, if that is near."""
        response = self.response
        now, damped = float(response.speed[0]), np.all(response.damping_ratio > 0)
        leaving = self.leaves_at if damped else np.nan
        far = float(np.clip(np.nan_to_num(1.25 * leaving, posinf=0.0), 1.5 * now, 5 * now))
        speed = np.linspace(far / SPEEDS, far, SPEEDS)
        sweep = speed_sweep(self, response.train, speed, LEAST)
        given, w = response.driven, speed[:, None]
        still = given.preload + given.rate * given.travel + given.load
        rigid = (still + given.mass * w**2 * given.acceleration + given.damping * w * given.velocity) / given.lever
        return OverSpeed(sweep, top(rigid), bottom(rigid), leaving, self._hits(far, float(np.max(abs(still)))))

    def _hits(self, far: float, force: float) -> tuple[Hit, ...]:
        """Harmonics that meet the natural frequency below a speed and add a share of a ``force`` there."""
        response, lift = self.response, self.harmonics
        natural, damping = float(response.natural_frequency), max(float(response.damping_ratio), 1e-6)
        n = np.arange(1, min(MOST_HITS, len(lift) - 1) + 1)
        stiff, rate = (float(np.ravel(k)[0]) for k in (response.train.static_stiffness, response.driven.rate))
        adds = stiff**2 / (stiff + rate) * lift[n] / (2 * damping)
        counts = n[(adds > COUNTS * force) & (natural / n <= far)]
        return tuple(Hit(int(k), natural / k, float(lift[k]), float(adds[k - 1])) for k in counts)

    @cached_property
    def flight(self) -> Flight | None:
        """From rest, where the train leaves the cam; its return spring counts without surge.  ``None``: it stays."""
        if np.any(self.form_closed) or not self.response.least_force < 0:
            return None
        return simulate(self, replace(self.response.train, spring=MasslessSpring()), turns=TURNS)

    @cached_property
    def lag_and_gap(self) -> tuple[Array, Array]:
        """By how much the train is shorter than at rest, and how far the follower is off the cam, m or rad."""
        if (flight := self.flight) is None:
            turn, place = np.append(self.response.cam_angle, TURN), self.response.position
            end = np.interp(self.cam_angle, turn, np.append(place, place[0]))
            return self._travel - end, 0.0 * end
        at = self.cam_angle + (TURNS - 1) * TURN
        end, gap = (np.interp(at, flight.cam_angle, values) for values in (flight.position, flight.gap))
        return self._travel + gap - end, gap

    @property
    def _travel(self) -> Array:
        travel: Array = self.motion.s - self.response.driven.level[0]
        return travel

    # ---------------------------------------------------------------- drawn

    @cached_property
    def _arm(self) -> Outline:
        """The follower's stem or arm."""
        found: Outline = next(body for body in self._of_cam("bodies") if body.part == "arm")
        return found

    @property
    def _length(self) -> float:
        """Of the train as it is drawn; of one on an arm rad."""
        return AHEAD if self.rocks else LENGTH * float(np.max(self._arm.y))

    @cached_property
    def exaggeration(self) -> float:
        """How many times larger than it is a deflection is drawn: 1, 2, 5, 10, ...; a gap may be drawn smaller."""
        most = max(np.max(abs(part)) for part in self.lag_and_gap)
        share = SEEN * self._length / most if most > 0 else 1.0
        power = 10.0 ** np.floor(np.log10(share))
        return float(power * max(k for k in (1, 2, 5) if k * power <= share * (1 + 1e-9)))

    @property
    def train_bodies(self) -> tuple[Body, ...]:
        """The cam, the follower and the scheme of the train."""
        arm, (lag, gap) = self._arm, (self.exaggeration * part for part in self.lag_and_gap)
        move, train = (_turned, _on_arm) if self.rocks else (_lifted, _on_stem)
        off, behind = self._way * gap, self._way * (gap - lag)
        shown = (body for body in self._of_cam("bodies") if self.rocks or body.part not in ("arm", "pivot"))
        parts = (move(body, off, arm) if body.name == arm.name else body for body in shown)
        return *parts, *train(move(arm, off, arm), arm, behind, self._way)

    @property
    def _way(self) -> float:
        """Whether an arm turns counter-clockwise as the follower rises, +1, or -1; of a stem 1."""
        if not self.rocks:
            return 1.0
        angle = np.unwrap(self._arm.angle)
        return float(np.sign(np.sum((angle - angle.mean()) * (self.motion.s - self.motion.s.mean())))) or 1.0


def _lifted(body: Body, by: Array, arm: Outline) -> Body:
    """A part of a follower on a stem, off the cam."""
    return replace(body, y=body.y + by)


def _turned(body: Body, by: Array, arm: Outline) -> Body:
    """A part of a follower on an arm, turned about the arm's pivot."""
    pivot = vector(arm.x, arm.y)
    x, y = rotated(vector(body.x - pivot[0], body.y - pivot[1] + 0.0 * by), by) + pivot[:, None]
    return replace(body, x=x, y=y) if isinstance(body, Disc) else replace(body, x=x, y=y, angle=body.angle + by)


def _on_stem(foot: Body, at_rest: Outline, behind: Array, way: float) -> tuple[Body, ...]:
    """Train, mass and return spring above a foot."""
    high, x = float(np.max(at_rest.y)), at_rest.x + 0.0 * behind
    long, wide = LENGTH * high, 0.3 * high
    under = at_rest.y + behind + long
    over, roof = under + 0.5 * wide, float(np.max(under)) + 0.5 * wide + 0.6 * long
    bar = np.array([[-0.8 * wide, 0.8 * wide], [0.0, 0.0]])
    return (
        Coil("train", "spring", x=foot.x + 0.0 * behind, y=foot.y, end=vector(x, under), width=0.5 * wide, turns=4),
        Outline("load", "mass", wide * COG, x=x, y=under),
        Coil("return spring", "spring", x=x, y=over, end=vector(x, roof + 0.0 * x), width=0.8 * wide, turns=6),
        Outline("", "frame", bar, x=at_rest.x, y=roof),
    )


def _on_arm(arm: Body, at_rest: Outline, behind: Array, way: float) -> tuple[Body, ...]:
    """A second arm with the load ahead of the follower's, the train between them, and the return spring."""
    length = 0.85 * float(np.max(abs(at_rest.points[0])))
    pivot, angle = vector(at_rest.x, at_rest.y)[:, None], at_rest.angle + way * AHEAD + behind
    first, last = (pivot + length * vector(np.cos(a), np.sin(a)) for a in (arm.angle, angle))
    far = float(np.max(way * np.unwrap(angle))) * way + way * AHEAD
    held, wide = pivot[:, 0] + length * vector(np.cos(far), np.sin(far)), 0.16 * length
    rod, bar = np.array([[0.0, length], [0.0, 0.0]]), wide * np.array([[-1.0, 1.0], [0.0, 0.0]])
    place = {"x": at_rest.x, "y": at_rest.y}
    block = 2 * wide * (COG - np.array([[0.0], [0.25]]))
    return (
        Outline("load", "arm", rod, angle=angle, **place),
        Coil("train", "spring", x=first[0], y=first[1], end=last, width=wide, turns=4),
        Outline("load", "mass", block, x=last[0], y=last[1], angle=angle),
        Coil("return spring", "spring", x=last[0], y=last[1], end=held, width=1.2 * wide, turns=6),
        Outline("", "frame", bar, x=held[0], y=held[1], angle=far),
    )
