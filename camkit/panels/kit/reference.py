"""What a person wishes of each objective, dragged on the picture of a front or typed: the nearest design is loaded."""

from __future__ import annotations

from collections.abc import Callable

from ...decision import achievement
from ...quantities import Measure
from ...quantities.types import Array
from ...search.front import Front
from ...units import factor
from .drawn import LivePicture
from .inputs import Amount
from .parts import Group, Words, row
from .quiet import Quiet


class ReferencePoint:
    """A reference point among the objectives of a front; ``box`` has a number for each of them.

    Until it is moved it stands at the ideal, the best of each objective.  Where it is moved, ``moved()`` is called, and
    ``select(i)`` for the design that comes nearest (see `achievement`).
    """

    def __init__(self, picture: LivePicture, select: Callable[[int], None], moved: Callable[[], None]) -> None:
        self._select, self._moved = select, moved
        self._front: Front | None = None
        self._objectives: tuple[Measure, ...] = ()
        self.wished: list[float] | None = None
        """The objectives that a person wishes, all to be small, SI; ``None`` until one does."""
        self._quiet = Quiet()
        self.box = Group(look="fold", description="Reference point: what you wish of each objective")
        picture.on_move("reference", self._dragged)

    def show(self, front: Front) -> None:
        """Stand beside another front; what is wished stays if it has the same objectives."""
        self._front = front
        if front.study.minimise != self._objectives:
            self._objectives, self.wished = front.study.minimise, None
            several = self._objectives[1:] and self._objectives
            self.box.children = tuple(self._row(k, measure) for k, measure in enumerate(several))
        self.box.visible = self.point is not None
        self._fill()

    def _fill(self) -> None:
        """The boxes say where it stands."""
        for inside, measure, wish in zip(self.box.children, self._objectives, self.point or (), strict=False):
            with self._quiet:
                inside.children[1].value = float(f"{measure.sign * wish / factor(measure.unit):.6g}")

    def _row(self, k: int, measure: Measure) -> Group:
        amount = Amount(unit=measure.unit, description=f"wish for the {measure.name}")
        self._quiet.hear(amount, lambda value: self._wish({k: value}))
        return row(Words(value=[measure.name]), amount)

    @property
    def point(self) -> tuple[float, ...] | None:
        """The objectives that are wished, all to be small, SI; ``None`` where there is nothing to choose."""
        if self._front is None or not len(self._front) or len(self._objectives) < 2:
            return None
        return tuple(self.wished or self._front.f.min(0).tolist())

    def _dragged(self, view: int, at: Array) -> None:
        self._wish(dict(enumerate(map(float, at))))

    def _wish(self, values: dict[int, float]) -> None:
        """Other values of some objectives, in their units."""
        if self.point is None:
            return
        self.wished = list(self.point)
        for k, value in values.items():
            self.wished[k] = self._objectives[k].sign * value * factor(self._objectives[k].unit)
        nearest = achievement(self._front, self.wished)
        self._fill()
        self._moved()
        self._select(nearest)
