"""Any cam with an elastic train behind it, as a design of its own: the forces of the cam are then those of the train.

>>> from camkit import Study, TranslatingFlatCam
>>> from camkit.cam import peak_force
>>> machine = ElasticFollower(TranslatingFlatCam())
>>> study = Study(machine, ["cam.load.preload", "train.damping"], (peak_force,), at_least={contact_margin: 0.2})
>>> print(f"{study.evaluate(study.x0).f[0, 0]:.1f} N")
150.3 N
"""

from __future__ import annotations

from dataclasses import dataclass, field, make_dataclass, replace
from functools import cache, cached_property
from typing import Any, ClassVar, Protocol, cast

import numpy as np

from ..motion import MotionProgram
from ..motion.closing import TURN
from ..motion.resolution import Resolution, resolve
from ..quantities import Analysable, Conversion, Design, LeastMeasure, Measure, PeakMeasure, choice
from ..quantities.design import refuse_no_cam, with_more
from ..quantities.kinds import refuse_arguments, whole
from ..quantities.types import Array, Value
from ..study import Study
from ..study.free import Menu
from .at_speed import Shown
from .beside_plain import BesidePlain, conversions_of
from .driven import Analysed, top
from .ranges import MAKERS
from .steady import LEAST, MOST, Response, respond
from .trains import ElasticArm, ElasticTrain, Train, TrainChain
from .tuning import first_stroke

TRAINS = ElasticTrain(), ElasticArm(), TrainChain()
"""What a cam can drive, for a menu."""


class Elastic(Analysed, Protocol):
    """The analysis of a cam with an elastic train."""

    response: Response
    samples: int

    @property
    def cam_angle(self) -> Array: ...

    @property
    def acceleration(self) -> Array: ...

    @property
    def resistance(self) -> Array: ...

    @property
    def program(self) -> MotionProgram: ...

    @property
    def leaves_at(self) -> Value: ...

    def steps(self) -> int: ...


@dataclass(frozen=True)
class ElasticFollower(Design):
    """A ``cam`` with one follower, whatever it is, and the elastic ``train`` between it and the load.

    Its analysis is that of the cam in all but the forces, which are those of the train in steady motion at the cam's
    speed: contact force, torque, pressure, wear.  So measures, limits and views of the cam serve it, and so do searches
    and tolerances: quantities of both have paths, ``cam.motion.rise.angle`` and ``train.stiffness``.  The ``response``
    of the analysis has what a train has besides.

    >>> from camkit import SlideLoad, TranslatingRollerCam, rpm
    >>> load = SlideLoad(mass=2.0, speed=600 * rpm, preload=300.0)
    >>> at_speed = ElasticFollower(TranslatingRollerCam(groove=False, load=load)).analyse()
    >>> print(f"dynamic factor {dynamic_factor(at_speed):.3f}, leaves at {contact_loss(at_speed) / rpm:.0f} rpm")
    dynamic factor 1.112, leaves at 698 rpm

    Raises ``ValueError`` for what is no cam; `analyse` does as `Train.follow` does.
    """

    cam: Design
    train: Train = choice("T", TRAINS[0], TRAINS, "elastic train between cam and load")
    samples: int = LEAST
    """Of a turn, at which steady motion is found, at least."""

    answers_for: ClassVar[tuple[str, ...]] = ("cam",)
    name: ClassVar[str] = "cam with an elastic train"

    def __post_init__(self) -> None:
        refuse_no_cam(self.cam, ElasticFollower)
        whole(self.samples, "the number of samples of a turn", 8, MOST)
        super().__post_init__()

    @property
    def conversions(self) -> tuple[Conversion, ...]:
        """A polydyne cam for its train (see `camkit.dynamics.polydyne`), and back to the plain one."""
        return conversions_of(self)

    def analyse(self, n: int = 721) -> Any:
        """The cam at ``n`` cam angles, with the forces of the train."""
        rigid = cast(Analysable, self.cam).analyse(n)
        response = respond(self.train, rigid, least=self.samples + self.samples % 2)
        return with_more(rigid, _elastic, response=response, samples=self.samples)


def elastic_study(study: Study[Any], train: Train, samples: int = LEAST) -> Study[ElasticFollower]:
    """A study of a cam with an elastic ``train`` behind it: the same free quantities, objectives and limits.

    They are those of the forces of the train; the paths of what is free begin with ``cam``.  Quantities of the train
    are freed with `Study.freeing`, its measures limited with ``replace``.

    >>> from camkit import HighSpeedCam
    >>> from camkit.dynamics import tuned
    >>> from camkit.machines import high_speed_study
    >>> train = tuned(ElasticArm(), HighSpeedCam().analyse(), period_ratio=5)
    >>> study = elastic_study(high_speed_study(), train)
    >>> print(list(study.free)[0], f"{study.evaluate(study.x0).f[0, 0] * 0.001**0.5:.4f}")
    cam.arm_length 2.5954
    """
    refuse_arguments(elastic_study, locals())
    free = {
        f"cam.{name}": replace(b, paths=tuple(f"cam.{path}" for path in b.paths)) if isinstance(b, Menu) else b
        for name, b in study.free.items()
    }
    return study.replace(start=ElasticFollower(study.start, train, samples), free=free)


@cache
def _elastic(kind: Any) -> Any:
    """The analysis of a cam of a ``kind``, with the forces of a train."""
    more = [("response", Response, field(kw_only=True, repr=False)), ("samples", int, field(kw_only=True))]
    resolution = cached_property(_resolution)
    resolution.__set_name__(kind, "resolution")
    own = {"resistance": property(_resistance), "resolution": resolution, "at_speeds": _at_speeds}
    return make_dataclass(f"Elastic{kind.__name__}", more, bases=(BesidePlain, Shown, kind), frozen=True, namespace=own)


def _resistance(analysis: Elastic) -> Array:
    """What the cam has to overcome along the travel, N or N m."""
    response = analysis.response
    part = response.train.cam_side_mass * response.speed**2 * analysis.acceleration
    force: Array = response.train_force_at(analysis.cam_angle) + part
    return force


def _at_speeds(analysis: Any, speeds: Array) -> Any:
    """The same cam and train at several speeds, ``(k,)``: a population of as many."""
    response = respond(analysis.response.train, analysis, speeds[:, None], least=analysis.samples)
    return replace(analysis, response=response)


def _resolution(analysis: Elastic) -> Resolution:
    """Cam angles that show the swings of the train, in the dwells too: as many for every train."""
    load, steps = getattr(analysis.cam, "load", None), max(analysis.steps(), analysis.samples // 4)
    angles, levels = (getattr(load, name, ()) for name in ("cam_angle_table", "travel_table"))
    return resolve(analysis.program, steps, [x for x, _ in angles], [x for x, _ in levels], steps)


# ---------------------------------------------------------------- measures


def _still(analysis: Elastic) -> Array:
    """Vibration in each dwell over the travel; 0 where there is no dwell."""
    response = analysis.response
    found, travel = response.dwell_vibration, np.ptp(response.driven.travel, axis=-1)
    shares: Array = found / np.expand_dims(travel, -1)
    return shares if shares.shape[-1] else np.zeros((*shares.shape[:-1], 1))


def _margin(analysis: Elastic) -> Array:
    margin: Array = analysis.resistance / analysis.response.held
    return margin


def _left(analysis: Elastic) -> Value:
    return analysis.leaves_at + _unknown(analysis)


def _margin_of_speed(analysis: Elastic) -> Value:
    return analysis.leaves_at / analysis.response.speed[..., 0] - 1


def _unknown(analysis: Elastic) -> float:
    """0; ``nan`` if the cam has its speed as a share of a rated one and nobody knows that."""
    return np.nan if getattr(analysis, "rated", False) else 0.0


def _periods(analysis: Elastic) -> Value:
    response = analysis.response
    return response.natural_frequency / response.speed[..., 0] * first_stroke(analysis)[..., 0] / TURN


def _swing(analysis: Elastic) -> Value:
    response = analysis.response
    return response.max_acceleration / top(response.driven.acceleration * response.speed**2)


dynamic_factor = Measure("dynamic factor", "", lambda a: a.response.dynamic_factor)
contact_margin = LeastMeasure(
    "minimum force along the travel, of that at rest",
    "%",
    lambda a: a.lowest(_margin).value,
    angle=lambda a: a.seen_at,
    points=lambda a: a.seen(_margin, -1),
)
contact_loss = Measure("speed at which the train leaves the cam", "rpm", _left)
contact_loss_margin = Measure("overspeed before the train leaves the cam", "%", _margin_of_speed)
dwell_vibration = PeakMeasure("vibration in the dwells, of the travel", "%", _still)
acceleration_ratio = Measure("peak acceleration of the load, of the cam's", "%", _swing)
natural_frequency = Measure("natural frequency", "Hz", lambda a: a.response.natural_frequency / TURN + _unknown(a))
period_ratio = Measure("natural periods in the first stroke", "", _periods)
damping_ratio = Measure("damping ratio", "%", lambda a: a.response.damping_ratio)

ElasticFollower.makers = MAKERS
ElasticFollower.measures = (
    dynamic_factor,
    contact_margin,
    contact_loss,
    contact_loss_margin,
    dwell_vibration,
    acceleration_ratio,
    natural_frequency,
    period_ratio,
    damping_ratio,
)
