"""What rides on a valve cam: a flat face or a roller, in line with the cam axis.

The follower travels along +y of the machine's frame; the cam turns counter-clockwise.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from ..cam.translating_flat import TranslatingFlatAnalysis, TranslatingFlatCam
from ..cam.translating_roller import TranslatingRollerAnalysis, TranslatingRollerCam
from ..motion import MotionProgram
from ..quantities import unremarked

if TYPE_CHECKING:
    from .valve_cam import ValveCam


@dataclass(frozen=True)
class FlatFollower:
    """A flat face across the line of travel (see `camkit.cam.translating_flat`)."""

    name: ClassVar[str] = "flat face"
    analysis: ClassVar[type[TranslatingFlatAnalysis]] = TranslatingFlatAnalysis

    def on(self, cam: ValveCam, motion: MotionProgram) -> TranslatingFlatCam:
        """The disk cam that lifts the face by ``motion``."""
        with unremarked():
            return TranslatingFlatCam(motion, cam.base_radius, load=cam.load)


@dataclass(frozen=True)
class RollerFollower:
    """A roller whose centre travels in line with the cam axis (see `camkit.cam.translating_roller`)."""

    name: ClassVar[str] = "roller"
    analysis: ClassVar[type[TranslatingRollerAnalysis]] = TranslatingRollerAnalysis

    def on(self, cam: ValveCam, motion: MotionProgram) -> TranslatingRollerCam:
        """The disk cam that lifts the roller by ``motion``."""
        with unremarked():
            return TranslatingRollerCam(motion, cam.base_radius, cam.roller_radius, load=cam.load, groove=False)


FLAT, ROLLER = FlatFollower(), RollerFollower()
FOLLOWERS = (FLAT, ROLLER)
