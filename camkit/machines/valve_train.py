"""What rides on a valve cam and what it moves: a flat face or a roller in line with the cam axis, valve and spring."""

from __future__ import annotations

from dataclasses import dataclass

from ..cam.slide import SlideLoad
from ..quantities import quantity, unless
from .valve_analysis import FlatValveAnalysis, RollerValveAnalysis, ValveAnalysis


@dataclass(frozen=True)
class Follower:
    """What rides on the cam, by its ``name``, and what follows from a cam under it."""

    name: str
    analysis: type[ValveAnalysis]


FLAT, ROLLER = Follower("flat face", FlatValveAnalysis), Follower("roller", RollerValveAnalysis)
FOLLOWERS = (FLAT, ROLLER)


@dataclass(frozen=True)
class ValveLoad(SlideLoad):
    """The load of a sliding follower, of a size as valves have it (defaults: a truck engine's).

    The closing flank mirrors the opening one, and so must the load: what resists may be tabulated over the lift.

    >>> ValveLoad(cam_angle_table=((0.0, 5.0), (1.0, 9.0)))
    Traceback (most recent call last):
        ...
    ValueError: the load has a table over the cam angle; that of a valve must be the same on both flanks: tabulate it \
over the lift, as its force table
    """

    mass: float = quantity(
        "m_v", 0.25, 0.02, 1, "kg", "valve, spring's share, tappet, as felt at the cam", name="follower mass"
    )
    speed: float = quantity("omega", 1800, 300, 4000, "rpm", "speed of the camshaft", name="cam speed")
    force: float = quantity("F", 0, -500, 500, "N", "constant resisting force", above=None, name="resisting force")
    spring_rate: float = quantity("c", 30, 0, 100, "N/mm", "valve spring", at_least=0, name="spring rate")
    preload: float = quantity(
        "F_0", 250, 0, 1000, "N", "valve spring with the valve shut", at_least=0, name="spring preload"
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if len(self.cam_angle_table):
            raise ValueError(
                "the load has a table over the cam angle; that of a valve must be the same on both flanks: "
                "tabulate it over the lift, as its force table"
            )
        if refuse := unless(self.damping == 0):
            refuse(
                f"the damping of the load is {self.damping:.6g} N s/m; that of a valve must be 0: it would not be the "
                "same on both flanks"
            )

    def following(self) -> dict[str, str]:
        """Nothing rubs with the velocity."""
        return {**super().following(), "damping": "a valve's load is the same on both flanks"}
