"""An elastic train in time: it leaves the cam where the contact would have to pull, flies, and strikes the cam again.

Between two events the equations are linear.  A step is exact but for the parabola through three values of what drives
it: cam and load.  Steps end at the joints of the motion, events are found as roots.

On the cam the near end of the train moves by ``s``; contact is lost where ``N`` falls to 0.  In flight a near end
without mass bears no force, ``T = -N_0``, and relaxes by ``k_f (p - x) + c_f omega (p' - x') = -N_0``; one with a mass
``m_0`` moves by ``m_0 omega^2 p'' = -N_0 - T``.  Back at ``p = s`` it takes the cam's velocity, by an impulse
``m_0 omega (s' - p')``; a strike after which ``N`` is below 0 leaves again at once.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ..motion.closing import TURN
from ..quantities import counted
from ..quantities.design import refuse_population
from ..quantities.kinds import numbers, refuse_arguments, shown
from ..quantities.types import Array
from .driven import Analysed, Driven, driven
from .steady import a_speed, grounded, last_mass, response_of
from .trains import Train, series_matrix

STEPS = 2880
"""Of a turn, at least."""
PER_RADIAN = 0.1
"""Of the natural motion, in a step, at most."""
MOST_STEPS = 100_000
MOST_TURNS = 1000
HAIR = 1e-14
"""To this an event is found, rad; the phase has then ended by a few of them."""
HALVINGS, MOST_EVENTS = 40, 8
"""Of a step, until a phase has begun; so many events are followed in one step."""


class Event(NamedTuple):
    """Where the follower leaves the cam (``off``) or comes back to it (``on``)."""

    kind: str
    cam_angle: float
    """Counted from the start over the turns, rad."""
    impulse: float
    """With which it strikes, N s, or N m s of an arm; 0 without a mass at the cam."""


@dataclass(frozen=True)
class Flight:
    """A train over some turns of its cam, with contact and without."""

    cam_angle: Array = field(repr=False)
    """Counted on over the turns, rad."""
    position: Array = field(repr=False)
    """Of the last mass, m or rad."""
    gap: Array = field(repr=False)
    """Between cam and follower along the travel, m or rad; 0 in contact."""
    resistance: Array = field(repr=False)
    """``N``: along the travel, N or N m; 0 in flight."""
    events: tuple[Event, ...]

    @property
    def max_gap(self) -> float:
        """The largest gap, m or rad."""
        return float(self.gap.max())

    @property
    def impulse(self) -> float:
        """The strongest strike, N s or N m s; 0 where there is none."""
        return max((event.impulse for event in self.events), default=0.0)


def simulate(
    analysis: Any, train: Train, speed: float | None = None, turns: int = 1, state: ArrayLike | None = None
) -> Flight:
    """A train from cam angle 0, where the cam is at ``speed`` (rad/s; that of the load), over some turns.

    It begins on the cam, at rest or in another ``state``: the places of its masses from the cam to the load (m, or rad)
    and then their velocities by time.

    >>> from camkit import TranslatingFlatCam, rpm
    >>> from camkit.dynamics import ElasticTrain
    >>> flight = simulate(TranslatingFlatCam().analyse(), ElasticTrain(), 1100 * rpm)
    >>> [(event.kind, round(float(np.degrees(event.cam_angle)), 1)) for event in flight.events]
    [('off', 70.1), ('on', 139.9), ('off', 158.4), ('on', 189.9), ('off', 205.4), ('on', 276.7), ('off', 293.9)]

    Raises ``ValueError`` for a population, a return spring with surge, turns that are no whole number of at least 1, a
    state of another size, and as `Train.follow` does.
    """
    refuse_arguments(simulate, locals())
    refuse_population(analysis, "the analysis")
    refuse_population(train, "the train")
    counted(turns, "turns", 1, MOST_TURNS)
    if np.any(getattr(analysis, "form_closed", False)):
        raise ValueError("a groove holds the follower from both sides; there is no flight to follow")
    if train.spring.name != "without mass":
        raise ValueError("the return spring of the train surges; in flight it must be one without mass")
    run = _Run(analysis, train, speed if speed is None else float(a_speed(speed)))
    return run.over(turns, _begun(state, run.n))


def _begun(state: ArrayLike | None, masses: int) -> Array:
    """The places and velocities of so many masses in the beginning; ``ValueError`` for what are none."""
    begun = np.zeros(2 * masses) if state is None else numbers(state, "the state of the train")
    if begun.shape != (2 * masses,) or not np.isfinite(begun).all():
        raise ValueError(
            f"the state of the train is {shown(state)}; it must be {2 * masses} finite numbers: the places of its "
            "masses, and their velocities"
        )
    return begun


class _Step(NamedTuple):
    """A step of ``y' = A y + f``, by cam angle: ``E y`` and what the values of ``f`` at its ends and middle add."""

    E: Array
    weights: tuple[Array, Array, Array]

    @classmethod
    def of(cls, A: Array, h: float) -> _Step:
        """With a parabola through the three values of ``f``."""
        from scipy.linalg import expm

        n, one = len(A), np.eye(len(A))
        whole = np.zeros((4 * n, 4 * n))
        whole[:n, :n] = A
        for i in range(3):
            whole[i * n : (i + 1) * n, (i + 1) * n : (i + 2) * n] = one
        E, first, second, third = np.split(expm(whole * h)[:n], 4, axis=1)
        slope, bend = second / h, 2 * third / h**2
        return cls(E, (first - 3 * slope + 2 * bend, 4 * slope - 4 * bend, 2 * bend - slope))

    def adds(self, f: Array) -> Array:
        """What steps from end to end add to ``E y``; ``f`` has a row for each of their ends and middles."""
        a, b, c = (weight.T for weight in self.weights)
        return f[:-2:2] @ a + f[1::2] @ b + f[2::2] @ c


class _Phase(NamedTuple):
    """Linear equations by cam angle, ``y' = A y + B u``, of ``u = (s, v, q, w, 1)``."""

    A: Array
    B: Array


class _Run:
    """The equations of one train on one cam, in contact and in flight."""

    def __init__(self, analysis: Analysed, train: Train, speed: float | None) -> None:
        self.analysis, self.train = analysis, train
        response = response_of(train, driven(analysis, 720), speed)
        self.given: Driven = response.driven
        self.speed = float(response.speed[0])
        self.start, self.near_mass = float(self.given.preload[0]), float(np.ravel(train.cam_side_mass)[0])
        self.k, self.c = (float(x) for x in train.springs[0])
        self.masses = np.array([float(np.ravel(m)[0]) for m in (*train.masses, last_mass(train, self.given))])
        self.n = len(self.masses)
        fastest = max(float(response.natural_frequencies[-1]), self._near_frequency)
        self.steps = int(max(STEPS, TURN * fastest / self.speed / PER_RADIAN))
        if self.steps > MOST_STEPS:
            raise ValueError(
                f"the fastest motion of the train is {fastest / self.speed:.6g} times the speed of the cam; for a "
                f"flight it can be at most {MOST_STEPS * PER_RADIAN / TURN:.0f} times"
            )
        self.contact, self.flight = self._phase(True), self._phase(False)

    @property
    def _near_frequency(self) -> float:
        """Of the mass at the cam on the first spring, rad/s."""
        return float(np.sqrt(self.k / self.near_mass)) if self.near_mass else 0.0

    def _phase(self, contact: bool) -> _Phase:
        """Equations of the masses, and in flight of a mass at the cam too: ``y = (x, x', p, p')``."""
        n, w, m = self.n, self.speed, self.masses
        free = not contact and self.near_mass > 0
        springs = [(k, c) for k, c in self.train.springs]
        if not contact and not free:
            springs[0] = 0.0, 0.0
        ends = float(self.given.rate[0]), float(grounded(self.train, self.given)[0])
        K, C = (series_matrix([part[i] for part in springs], end) for i, end in enumerate(ends))
        size = 2 * n + 2 * free
        A, B = np.zeros((size, size)), np.zeros((size, 5))
        A[:n, n : 2 * n] = np.eye(n) / w
        A[n : 2 * n, :n], A[n : 2 * n, n : 2 * n] = -K / m[:, None] / w, -C / m[:, None] / w
        B[2 * n - 1, 2] -= 1 / m[-1] / w
        if contact:
            B[n, 0] += self.k / m[0] / w
            B[n, 1] += self.c / m[0]
        elif free:
            p, u = 2 * n, 2 * n + 1
            A[n, p], A[n, u] = self.k / m[0] / w, self.c / m[0] / w
            A[p, u] = 1 / w
            for place, spring in ((p, self.k), (u, self.c)):
                A[u, place] -= spring / self.near_mass / w
                A[u, place - p if place == p else n] += spring / self.near_mass / w
            B[u, 4] -= self.start / self.near_mass / w
        else:
            B[n, 4] -= self.start / m[0] / w
        return _Phase(A, B)

    def drive(self, angle: Array) -> Array:
        """``u`` at some cam angles, ``(k, 5)``."""
        at = self.given.at(self.analysis, angle)
        return np.stack([at.travel, at.velocity, at.load, at.acceleration, np.ones(len(angle))], axis=-1)

    def press(self, y: Array, u: Array) -> float:
        """``N`` in contact."""
        s, v, _, w, _ = u
        T = self.k * (s - y[0]) + self.c * (self.speed * v - y[self.n])
        return float(self.start + T + self.near_mass * self.speed**2 * w)

    def pieces(self) -> list[tuple[float, Array]]:
        """The smooth pieces of the motion: the step, and ``u`` at its ends and middles, ``(2 k + 1, 5)``."""
        resolution, found = self.analysis.cam.motion.resolution, []
        for first, last in zip(resolution.first, resolution.last, strict=True):
            low, high = (float(resolution.angle[i]) for i in (first, last))
            count = max(4, int(np.ceil((high - low) / TURN * self.steps)))
            found.append(((high - low) / count, np.linspace(low, high, 2 * count + 1)))
        values = self.drive(np.concatenate([angle for _, angle in found]))
        ends = np.cumsum([len(angle) for _, angle in found])[:-1]
        return [(step, part) for (step, _), part in zip(found, np.split(values, ends), strict=True)]

    def advance(self, phase: _Phase, y: Array, begin: float, by: float) -> tuple[Array, Array]:
        """``y`` and ``u`` at ``by`` rad after the cam angle ``begin``."""
        u = self.drive((begin + by * np.array([0.0, 0.5, 1.0])) % TURN)
        step = _Step.of(phase.A, by)
        return step.E @ y + step.adds(u @ phase.B.T)[0], u[-1]

    def over(self, turns: int, state: Array) -> Flight:
        """The run from a state over some turns."""
        path, pieces = _Path(self, state), self.pieces()
        for turn in range(turns):
            begin = turn * TURN
            for step, u in pieces:
                path.through(begin, step, u)
                begin += step * (len(u) // 2)
        return path.flight()


class _Path:
    """Where a run stands, and where it was."""

    def __init__(self, run: _Run, state: Array) -> None:
        self.run, self.y, self.flies = run, state, False
        self.left, self.stretch = 0.0, 0.0
        self.events: list[Event] = []
        self.seen: list[tuple[float, float, float, float]] = []
        u = run.drive(np.zeros(1))[0]
        self._note(0.0, force := run.press(self.y, u))
        if force < 0:
            self._leave(0.0, u)

    @property
    def phase(self) -> _Phase:
        return self.run.flight if self.flies else self.run.contact

    def gap(self, y: Array, u: Array, angle: float) -> float:
        """Between cam and near end, in flight."""
        run = self.run
        if run.near_mass:
            return float(y[2 * run.n] - u[0])
        fades = np.exp(-run.k * (angle - self.left) / (run.c * run.speed)) if run.c else 0.0
        slack = -run.start / run.k
        return float(y[0] + slack + (self.stretch - slack) * fades - u[0])

    def through(self, begin: float, step: float, u: Array) -> None:
        """Over one smooth piece of the motion."""
        phases = (self.run.contact, self.run.flight)
        steps = [(each.E, each.adds(u @ phase.B.T)) for phase in phases for each in [_Step.of(phase.A, step)]]
        for i, here in enumerate(u[2::2]):
            E, adds = steps[self.flies]
            now, end = begin + i * step, begin + (i + 1) * step
            y = E @ self.y + adds[i]
            kept = self._left(y, here, end)
            if kept < 0 or (self.flies and kept == 0):
                self._through_events(now, end)
                kept = self._left(self.y, here, end)
            else:
                self.y = y
            self._note(end, kept)

    def _left(self, y: Array, u: Array, angle: float) -> float:
        """What is left of a phase before it ends at 0: of the force in contact, of the gap in flight."""
        return self.gap(y, u, angle) if self.flies else self.run.press(y, u)

    def _through_events(self, now: float, end: float) -> None:
        """From one cam angle to another, with the events between."""
        for _ in range(MOST_EVENTS):
            y, u = self.run.advance(self.phase, self.y, now, end - now)
            if (kept := self._left(y, u, end)) > 0 or (kept == 0 and not self.flies):
                break
            now = self._event(now, end)
        else:
            y, u = self.run.advance(self.phase, self.y, now, end - now)
        self.y = y

    def _event(self, now: float, end: float) -> float:
        """The end of the phase between two cam angles; the state is then that after it."""
        high = self._root(now, end)
        self.y, u = self.run.advance(self.phase, self.y, now, high - now)
        if self.flies:
            self._strike(high, u)
        else:
            self._leave(high, u)
        return high

    def _root(self, now: float, end: float) -> float:
        """Where the phase ends between two cam angles; it may have begun with nothing left at the first."""
        from scipy.optimize import brentq

        def left(angle: float) -> float:
            return self._left(*self.run.advance(self.phase, self.y, now, angle - now), angle)

        high = end
        for _ in range(HALVINGS):
            middle = (now + high) / 2
            if left(middle) > 0:
                return min(float(brentq(left, middle, high, xtol=HAIR)) + 4 * HAIR, high)
            high = middle
        return high

    def _leave(self, angle: float, u: Array) -> None:
        run = self.run
        self.flies, self.left, self.stretch = True, angle, float(u[0] - self.y[0])
        self.events.append(Event("off", angle, 0.0))
        if run.near_mass:
            self.y = np.append(self.y, [u[0], run.speed * u[1]])

    def _strike(self, angle: float, u: Array) -> None:
        run, impulse = self.run, 0.0
        if run.near_mass:
            impulse = run.near_mass * (run.speed * u[1] - self.y[-1])
        self.flies, self.y = False, self.y[: 2 * run.n]
        self.events.append(Event("on", angle, float(abs(impulse))))
        if run.near_mass and run.press(self.y, u) < 0:  # without a mass N is at least 0 then
            self._leave(angle, u)

    def _note(self, angle: float, kept: float) -> None:
        self.seen.append((angle, float(self.y[self.run.n - 1]), *((kept, 0.0) if self.flies else (0.0, kept))))

    def flight(self) -> Flight:
        """What was seen."""
        angle, position, gap, force = np.transpose(self.seen)
        return Flight(angle, position, gap, force, tuple(self.events))
