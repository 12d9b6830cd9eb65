"""`tolerance_panel`: tolerances under sliders, and what the workshop then makes of the design in an explorer."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Protocol, runtime_checkable

import numpy as np

from ..quantities import Quantity, value_of, words
from ..quantities.kinds import refuse_arguments
from ..render.figure import picture, small_png
from ..search.front import Front
from ..study.spread import Tolerance
from ..study.study import Study
from ..study.tolerances import SPREADS, AnalysisCurve, Tolerances, general_tolerance, general_tolerances
from ..views.picture import Picture
from ..views.tolerances import cloud, deviation, sobol_bars
from .instrument import Instrument
from .kit.drawn import LivePicture
from .kit.inputs import Menu, Number
from .kit.latest_only import Debounced
from .kit.parts import Banner, Button, Group, Part, Table, Words, row
from .kit.sheet import IMPOSSIBLE, Panel

MOVING, SETTLED = 64, 512
"""How many parts are made while a slider moves, and when all is quiet."""
QUIET = 0.25
"""Seconds after the last move until all is quiet."""
HINT = "Plus and minus; a normal spread has them at three standard deviations."
HEADS = ("measure", "as drawn", "2.5 % are below", "2.5 % are above", "miss the limit")
WIDEST = 5
"""How many times the general tolerance a slider offers."""


@runtime_checkable
class HasFront(Protocol):
    """A panel or another thing with a front."""

    front: Front


class TolerancePanel(Panel):
    """What tolerances do to the design of an `Instrument`: yield, cloud of parts, bands on curves, Sobol indices.

    ``study`` says what is limited.  ``half_widths`` names the dimensions that spread, with their first tolerance (SI);
    without them these are the study's free quantities with general tolerances (ISO 2768-1, class m).  ``curves`` are
    those whose bands are drawn.  ``front`` is anything with a ``.front`` that changes (a `Search`), or a front.
    ``tolerances`` is what is shown; what is in the sliders are the explorer's tolerances, too.
    """

    def __init__(
        self,
        explorer: Instrument,
        study: Study,
        half_widths: Mapping[str, float] | None = None,
        curves: Sequence[AnalysisCurve] = (),
        front: HasFront | Front | None = None,
    ) -> None:
        refuse_arguments(TolerancePanel.__init__, locals())
        self.explorer, self.study = explorer, study
        self._front = front
        first = general_tolerances(study) if half_widths is None else dict(half_widths)
        self.tolerances = Tolerances(study.replace(start=explorer.design), first, parts=SETTLED)
        self.banner, self.numbers = Banner(), Table()
        self.knobs = {name: self._knob(name, half) for name, half in first.items()}
        self._first = first
        self.spread = Menu(SPREADS, "spread")
        self.spread.observe(lambda _: self._moved(), "value")
        self._later = Debounced(self._make_many, QUIET)
        kind = type(explorer.design).__name__
        self.picture = LivePicture((self._cloud, sobol_bars), f"Tolerances of the {kind}")
        self.bands = LivePicture(tuple(map(deviation, curves)), f"Deviations of the {kind}")
        self.picture.pixels, self.bands.pixels = 225, 155
        super().__init__(*self._body(), heading="Tolerances")
        self._show(self.tolerances)
        explorer.on_change(lambda _: self._later.ask())  # the sliders' own pictures come first
        if follow := getattr(front, "on_front", None):
            follow(self._later.ask)
        explorer.add_tab("Tolerances", self)

    def _knob(self, name: str, half: float) -> Number:
        nominal = self.tolerances.declared[name]
        widest = WIDEST * (half or general_tolerance(nominal, value_of(self.explorer.design, name))) / nominal.factor
        meaning = f"half width of the tolerance of the {words(name)}"
        declared = Quantity(nominal.symbol, half / nominal.factor, 0, widest, nominal.unit, meaning, at_least=0)
        return Number(name, declared, half, self._moved, self.banner.show_message)

    def _body(self) -> tuple[Part, ...]:
        knobs = Group(*self.knobs.values(), look="grid")
        reset = Button("Reset", self.reset, tooltip="back to the first tolerances")
        settings = row(self.spread, reset, Words(value=[HINT], look="hint"))
        return self.banner, Group(Group(knobs, settings), self.picture, look="beside"), self.bands, self.numbers

    def _cloud(self, tolerances: Tolerances) -> Picture:
        front = self._front.front if isinstance(self._front, HasFront) else self._front
        return cloud(front)(tolerances)

    @property
    def half_widths(self) -> dict[str, float]:
        """The tolerances in the sliders, SI."""
        return {name: knob.value for name, knob in self.knobs.items()}

    def reset(self) -> None:
        """Back to the first tolerances."""
        with self.held():
            for name, knob in self.knobs.items():
                knob.set(self._first[name])
            self._moved()

    def _moved(self) -> None:
        """Few parts at once, many when all is quiet."""
        self._show(self._made(MOVING))
        self._later.ask()

    def _made(self, parts: int) -> Tolerances | None:
        """What the workshop makes of the sliders; ``None``, and a sentence in place of the picture, if it cannot."""
        study = self.study.replace(start=self.explorer.design)
        try:
            made = Tolerances(study, self.half_widths, self.spread.value, parts)
            _ = made.values, made.indices  # now, and not while it is drawn, when nothing else can be
        except IMPOSSIBLE as refusal:
            self.refuse_picture(f"This cannot be made: {refusal}.")
            return None
        return made

    def settle(self) -> None:
        """Make many parts of what is in the sliders, if that is still to be done."""
        self._later.settle()

    def _make_many(self) -> None:
        made = self._made(SETTLED)
        if not self._later.waiting:  # nobody has moved anything since
            self._show(made)

    def _show(self, made: Tolerances | None) -> None:
        if made is None:
            return
        with self.held():
            try:
                for part in self._drawn:
                    part.show(made)
            except IMPOSSIBLE as refusal:
                self.refuse_picture(f"This cannot be made: {refusal}.")
                return
            self.tolerances = made
            spread = made.spread
            self.explorer.tolerances = {name: Tolerance(made.half_widths[name], spread) for name in made.names}
            self.numbers.put(HEADS, self._rows())
            self.refuse_picture("")

    @property
    def _drawn(self) -> list[LivePicture]:
        """What is drawn; without curves there are no bands."""
        return [self.picture, self.bands] if self.bands.views else [self.picture]

    def refuse_picture(self, sentence: str) -> None:
        """Show a sentence in place of the pictures and the numbers; an empty one brings them back."""
        with self.held():
            super().refuse_picture(sentence)
            self.bands.visible = not sentence

    def drawing(self) -> Callable[[], bytes]:
        """What draws all pictures in one."""
        shown, views = self.tolerances, [view for part in self._drawn for view in part.views]
        return lambda: small_png(picture(shown, *views))

    def _rows(self) -> list[tuple[str, str, str, str, str]]:
        """Every measure in words: its name, as drawn, where 2.5 % are below and above, which share misses a limit."""
        made, rows = self.tolerances, []
        for measure in made.measures:
            low, high = made.percentiles(measure, (2.5, 97.5))
            drawn = float(np.ravel(measure(made.nominal))[0])
            missed = [share for limited, share in made.missed.items() if limited == measure]
            told = f"{100 * max(missed):.1f} %" if missed else ""
            rows.append((measure.name, measure.text(drawn), measure.text(low), measure.text(high), told))
        return rows

    def summary(self) -> str:
        """The tolerances, the yield, and what the parts' measures lie between."""
        made = self.tolerances
        half = (f"{words(n)} ± {made.declared[n].text(v)}" for n, v in made.half_widths.items())
        rows = (f"{name}: {drawn}, parts {low} to {high}" for name, drawn, low, high, _ in self._rows())
        return "\n".join([f"{', '.join(half)}: {100 * made.share:.1f} % of parts keep all limits", *rows])


def tolerance_panel(
    explorer: Instrument, study: Study, half_widths: Mapping[str, float] | None = None, **options: Any
) -> TolerancePanel:
    """Sliders for the tolerances of the design in ``explorer``, and what they do to it (see `TolerancePanel`)."""
    return TolerancePanel(explorer, study, half_widths, **options)
