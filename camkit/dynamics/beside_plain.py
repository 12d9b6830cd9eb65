"""What a train gains by a polydyne cam: any cam with a train can be made one, and is shown beside the plain cam."""

from __future__ import annotations

from functools import cached_property, partial
from typing import NamedTuple, Protocol, cast

import numpy as np
from numpy.typing import ArrayLike

from ..motion import MotionProgram
from ..quantities import Analysable, Conversion, Design
from ..quantities.applied import applied
from ..quantities.kinds import refuse_arguments
from ..quantities.types import Value
from ..units import in_unit
from .driven import Analysed
from .polydyne import PolydyneProgram, polydyne
from .speeds import SpeedSweep, speed_sweep
from .steady import LEAST, Response, enough
from .trains import Train

DERIVATIVES = "position", "velocity", "acceleration", "jerk"
ORDINALS = "second", "third", "fourth", "fifth"
SPEEDS, AROUND = 141, (0.5, 1.5)
"""So many speeds, between these shares of the design speed."""
MOST = 1440
"""Samples of a turn without asking: a train that swings more often in a turn hardly swings."""


def conversions_of(machine: WithTrain) -> tuple[Conversion, ...]:
    """What a cam with an elastic train can be made into, if its motion is a program: a polydyne cam, and back."""
    motion = machine.cam.branches().get("motion")
    if not isinstance(motion, MotionProgram):
        return ()
    make = partial(_made, machine, motion)
    if not isinstance(motion, PolydyneProgram):
        meaning = "The cam behind whose train the load moves after this motion, at the speed that the cam has now"
        return (Conversion("Make it a polydyne cam", "cam.motion", meaning, make),)
    again = "The cam for this train and load, and the same wanted motion and design speed"
    back = Conversion(
        "Back to the cam as wanted",
        "cam.motion",
        "The cam itself moves after the wanted motion",
        lambda: (_with_motion(machine, motion.wanted), ""),
    )
    return Conversion("Fit it to this train", "cam.motion", again, make), back


def _with_motion(machine: WithTrain, motion: MotionProgram) -> Analysable:
    return machine.replace(cam=machine.cam.changed({"motion": motion}))


def _made(machine: WithTrain, motion: MotionProgram) -> tuple[Analysable, str]:
    """The polydyne cam, and what jumps in it."""
    wanted = motion.wanted if isinstance(motion, PolydyneProgram) else motion
    rigid = cast(Analysable, machine.cam.changed({"motion": wanted})).analyse()
    speed = motion.design_speed if isinstance(motion, PolydyneProgram) else rigid.speed
    made = polydyne(wanted, machine.train, rigid, speed)
    jumps = [(joint.order, joint.angle) for joint in made.transitions() if joint.order is not None]
    order, angle = min(jumps, default=(3, 0.0))
    if order == 3:
        return _with_motion(machine, made), ""
    sentence = (
        f"the {ORDINALS[order]} derivative of the wanted motion jumps at {in_unit(angle, 'deg'):.6g} deg, and with it "
        f"the {DERIVATIVES[order]} of its polydyne cam; take a law whose fourth derivative is continuous, such as the "
        "5-6-7-8-9 polynomial"
    )
    if order < 2:
        raise ValueError(sentence)
    return _with_motion(machine, made), f"{sentence[:1].upper()}{sentence[1:]}."


class WithTrain(Protocol):
    """A cam with an elastic train."""

    @property
    def cam(self) -> Design: ...
    @property
    def train(self) -> Train: ...
    def replace(self, **changes: object) -> Analysable: ...


class CamsOverSpeed(NamedTuple):
    """What a train does behind its polydyne cam and behind the plain one, over speeds of the cam."""

    polydyne: SpeedSweep
    plain: SpeedSweep
    """Behind the cam that would do without mass and damping: ``s = y (1 + k_s / k_f)``."""
    design_speed: Value
    """rad/s."""


def beside_plain(
    analysis: object, train: Train, speeds: ArrayLike | None = None, samples: int | None = None
) -> CamsOverSpeed:
    """The steady motion of a train behind a polydyne cam and behind the plain one, at ``speeds`` (rad/s).

    Without ``speeds`` they are from half to one and a half times the design speed.  ``samples`` as of `speed_sweep`.

    >>> from camkit import SlideLoad, TranslatingFlatCam, mm, rpm
    >>> from camkit.dynamics import ElasticTrain
    >>> from camkit.motion import Dwell, MotionProgram, Poly56789, Return, Rise
    >>> up, down = Rise(2.0, 20 * mm, Poly56789()), Return(2.0, 20 * mm, Poly56789())
    >>> wanted = MotionProgram((up, Dwell(1.0), down, Dwell(2 * np.pi - 5)))
    >>> train, load = ElasticTrain(damping=0, ground_damping=20), SlideLoad(mass=2, spring_rate=5e3, preload=300)
    >>> cam = TranslatingFlatCam(polydyne(wanted, train, load, 600 * rpm), base_radius=80 * mm, load=load)
    >>> cams = beside_plain(cam.analyse(), train, np.array([500, 600]) * rpm)
    >>> for sweep in cams[:2]:
    ...     print((1e6 * sweep.dwell_vibration.max(-1)).round(1), "um")
    [24.7  0. ] um
    [ 56.2 381.3] um

    Raises ``ValueError`` for a cam that is no polydyne cam, and as `speed_sweep` does.
    """
    refuse_arguments(beside_plain, locals())
    with applied("the comparison with a plain cam", analysis):
        motion = cast(Analysed, analysis).cam.motion
    if not isinstance(motion, PolydyneProgram):
        raise ValueError("the cam is no polydyne cam; there is no plain one beside it")
    if speeds is None:
        speeds = np.linspace(*AROUND, SPEEDS) * motion.design_speed
        frequency = train.follow(cast(Analysed, analysis), samples=LEAST).natural_frequency
        samples = samples or min(MOST, enough(frequency, speeds))
    plain = cast(Analysed, analysis).cam.replace(motion=motion.plain).analyse()
    made, beside = (speed_sweep(each, train, speeds, samples) for each in (analysis, plain))
    return CamsOverSpeed(made, beside, motion.design_speed)


class BesidePlain:
    """What the analysis of a cam with an elastic train shows of a polydyne cam; the kind of cam is a base after it."""

    cam: Design
    response: Response

    @property
    def offers(self) -> tuple[object, ...]:
        """What is shown where nobody chooses, a polydyne cam beside the plain one first of its curves."""
        first, *others = cast(tuple[object, ...], super().offers)  # type: ignore[misc]
        shown = (
            ("beside_plain", "forces_beside_plain")
            if isinstance(getattr(self.cam, "motion", None), PolydyneProgram)
            else ()
        )
        return (first, *shown, *others)

    @cached_property
    def beside_plain(self) -> CamsOverSpeed:
        """Over the speed, beside the plain cam."""
        return beside_plain(self, self.response.train)

    @property
    def forces_beside_plain(self) -> CamsOverSpeed:
        """The same."""
        return self.beside_plain
