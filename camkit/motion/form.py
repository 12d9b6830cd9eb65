"""The error of form of a profile as it is made: waves that ride on the motion of the follower."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from ..quantities import Declared, Quantity, quantity
from ..quantities.kinds import a_number, kind_words, shown, whole
from ..quantities.types import Array, Value
from .law import Kinematics
from .matched import MatchedProgram
from .program import MotionProgram
from .resolution import Resolution

OFFSET = Quantity("e_0", 0, -10, 10, "", "by how much the whole profile lies too far out", above=None)
AMPLITUDE = Quantity("A", 0, 0, 10, "", "of the waves on the profile", at_least=0)


@dataclass(frozen=True)
class FormError(Declared):
    """What the follower is moved too far by a profile as it was made: ``e = e_0 + A cos(k phi + theta)``.

    ``offset`` and ``amplitude`` are in the follower's unit (m or rad), ``waves`` is how many there are in a turn.  All
    physics follows, for it rides on the motion: ``s + e``, ``v + e'``, ``a + e''``, ``j + e'''``.  A tolerance of form
    bounds the amplitude alone and no slope; how many waves there are is the business of the machine that cuts it.

    >>> from camkit import TranslatingRollerCam, deg, mm
    >>> cam = TranslatingRollerCam()
    >>> wavy = cam.replace(motion=FormError(amplitude=0.01 * mm, waves=12).on(cam.motion))
    >>> print(f"{(wavy.analyse().motion.s - cam.analyse().motion.s).max() / mm:.3f} mm")
    0.010 mm

    Raises ``ValueError`` for numbers that are not finite, an amplitude below 0, and waves that are no whole number.
    """

    offset: Value = field(default=0.0, metadata={"declared": OFFSET, "by_owner": True})
    amplitude: Value = field(default=0.0, metadata={"declared": AMPLITUDE, "by_owner": True})
    phase: float = quantity("theta", 0, -180, 180, "deg", "of the waves at cam angle 0", above=None)
    waves: int = 12

    def __post_init__(self) -> None:
        whole(self.waves, "the number of waves in a turn", 1, 1000)
        super().__post_init__()
        a_number(self.offset, "the offset of the profile")

    def at(self, cam_angle: Array) -> Kinematics:
        """``e`` and its derivatives per rad, rad^2, rad^3."""
        k, turned = self.waves, self.waves * cam_angle + self.phase
        wave, slope = self.amplitude * np.cos(turned), -k * self.amplitude * np.sin(turned)
        return Kinematics(self.offset + wave, slope, -(k**2) * wave, -(k**2) * slope)

    def on(self, program: MotionProgram) -> FormedProgram | FormedMatchedProgram:
        """The motion of a follower on a profile with this error."""
        if not isinstance(program, MotionProgram):
            raise ValueError(
                f"an error of form rides on a motion program; {kind_words(type(program), article=True)} is none, "
                "and a machine whose motion follows from quantities of its own takes no error of form"
            )
        if hasattr(program, "with_form"):
            formed: FormedProgram = program.with_form(self)
            return formed
        if isinstance(program, MatchedProgram):
            return FormedMatchedProgram(program.parts, program.boundaries, program.rest, self, advance=program.advance)
        return FormedProgram(program.segments, program.start, self, advance=program.advance)


class Formed(MotionProgram if TYPE_CHECKING else object):  # type: ignore[misc]
    """What an error of form changes in the kind of motion program that it rides on."""

    form: FormError

    def __post_init__(self) -> None:
        if not isinstance(self.form, FormError):
            raise ValueError(f"the form is {shown(self.form)}; it must be a FormError")
        super().__post_init__()

    @property
    def waves(self) -> int:
        """How many waves ride on the motion in a turn."""
        return self.form.waves

    def branches(self) -> dict[str, Any]:
        """The segments by name, and the error of form."""
        return {**super().branches(), "form": self.form}

    def changed(self, changes: Mapping[str, Any]) -> Self:
        """With other segments by name, and with another error."""
        wanted: Any = super().changed(changes)
        return wanted.replace(form=changes.get("form", self.form))

    def over(self, shown: Resolution) -> Kinematics:
        """``s, v, a, j`` at the cam angles of a resolution."""
        return self._formed(super().over(shown), shown.angle)

    def _at(self, x: Array) -> Kinematics:
        return self._formed(super()._at(x), x)

    def _formed(self, motion: Kinematics, x: Array) -> Kinematics:
        return Kinematics(*(wanted + error for wanted, error in zip(motion, self.form.at(x), strict=True)))


@dataclass(frozen=True)
class FormedProgram(Formed, MotionProgram):
    """A motion program as a profile with an error of ``form`` gives it; see `FormError`.

    Its segments, its `transitions` and its `peaks` are those that are wanted; what is called with cam angles, and so
    every analysis of a cam, is what is made.
    """

    form: FormError = field(default_factory=FormError)


@dataclass(frozen=True)
class FormedMatchedProgram(Formed, MatchedProgram):
    """A matched program as a profile with an error of ``form`` gives it; see `FormedProgram`."""

    form: FormError = field(default_factory=FormError)
