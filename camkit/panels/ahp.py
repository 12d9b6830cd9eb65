"""`ahp_panel`: pairwise judgements under sliders or typed, their weights and consistency at once."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from fractions import Fraction

import numpy as np

from ..decision import SAATY_SCALE, Judgements, Judges, ahp, typed_judgement
from ..quantities.kinds import refuse_arguments
from ..views.front import weight_bars
from ..views.picture import View
from .kit.drawn import LivePicture
from .kit.inputs import Menu, Scale, Typed
from .kit.parts import Banner, Button, Group, Part, Table, Words, bold, row
from .kit.quiet import Quiet
from .kit.sheet import Panel

Pair = tuple[int, int]

HINT = (
    "A knob stands nearer to what matters more: 1 equally, 3 moderately, 5 strongly, 7 very strongly, 9 extremely. "
    "A box takes any number or fraction: 3, 1/5, 0.4. Leave it empty where you cannot judge."
)


MOST_PAIRS = 10
"""So many pairs stand below each other; of more, those of one criterion at a time."""


class AhpPanel(Panel):
    """Saaty's judgements: for each pair of criteria a slider from 1/9 to 9 and a box to type in.

    A pair may be left without a judgement (an empty box; its slider then shows, pale, what the others imply) as long
    as the rest connect all criteria.  Among more than five criteria a menu says whose pairs are shown.
    ``judgements`` and ``weights`` follow at once; ``on_change(f)`` calls ``f()`` after every change.
    """

    _view: View = staticmethod(weight_bars)

    def __init__(self, judgements: Judgements | Judges, title: str = "") -> None:
        refuse_arguments(AhpPanel.__init__, locals())
        self.start = self.given = judgements
        self.judgements = judgements.judgements if isinstance(judgements, Judges) else judgements
        self.said = self.judgements
        self.names = tuple(judgements.names)
        self._quiet = Quiet()
        methods = [("eigenvector", "eigenvector"), ("geometric mean", "geometric")]
        self.method = Menu(methods, "weights by")
        self._quiet.hear(self.method, lambda _: self._judge(self.said))
        self.sliders = {pair: self._slider(pair) for pair in self.said.pairs}
        self.boxes = {pair: self._box(pair) for pair in self.said.pairs}
        self._rows = {pair: self._row(pair) for pair in self.said.pairs}
        of = [(name, k) for k, name in enumerate(self.names)]
        self.of = Menu(of, "judge all against", visible=len(self._rows) > MOST_PAIRS)
        self.of.observe(lambda _: self._show_pairs(), "value")
        height = 0.9 + 0.5 * len(self.names)
        self.picture = LivePicture((self._view,), f"Weights of {', '.join(self.names)}", width=7.2, height=height)
        self.numbers, self.banner = Table(), Banner()
        super().__init__(self._body(), heading=title)
        self._show_pairs()
        self.load(judgements)

    def _body(self) -> Part:
        back = "back to the judgements that the panel began with"
        reset = Button("Reset", lambda: self.load(self.start), tooltip=back)
        rows = Group(*(part for parts in self._rows.values() for part in parts), look="pairs")
        hint = Words(value=[HINT], look="hint")
        left = [*self._questions(), self.of, rows, hint, row(reset, self.method), self.banner]
        right = [self.picture, *self._answers()]
        (right if self.of.visible else left).append(self.numbers)
        return Group(Group(*left), Group(*right), look="beside")

    def _questions(self) -> tuple[Part, ...]:
        """What stands above the pairs."""
        return ()

    def _answers(self) -> tuple[Part, ...]:
        """What stands below the picture."""
        return ()

    def _show_pairs(self) -> None:
        """The pairs that there is room for."""
        with self.held():
            for pair, parts in self._rows.items():
                for part in parts:
                    part.visible = self.of.value in pair or not self.of.visible

    def _slider(self, pair: Pair) -> Scale:
        options = [(as_fraction(v), v) for v in SAATY_SCALE[::-1]]
        slider = Scale(options, f"{self.names[pair[0]]} against {self.names[pair[1]]}", value=1.0)
        self._quiet.hear(slider, lambda value: self._say(pair, value))
        return slider

    def _box(self, pair: Pair) -> Typed:
        first, second = (self.names[k] for k in pair)
        box = Typed(
            placeholder="not judged",
            description=f"{first} against {second}, number",
            tooltip=f"how many times {first} matters more than {second}",
        )
        self._quiet.hear(box, lambda text: self._typed(pair, text))
        return box

    def _row(self, pair: Pair) -> tuple[Part, ...]:
        first, second = (Words(value=[self.names[k]]) for k in pair)
        first.look = "right"
        return first, self.sliders[pair], second, self.boxes[pair]

    @property
    def weights(self) -> np.ndarray:
        """The weights of the criteria."""
        return self.judgements.weights

    def load(self, judgements: Judgements | Judges | Sequence[object]) -> None:
        """Show other judgements of the same criteria: `Judgements`, a matrix or what is above its diagonal.

        Of several judges those of the group.
        """
        judgements = judgements.judgements if isinstance(judgements, Judges) else judgements
        given = ahp(judgements)
        self._refuse_others(given)
        if isinstance(judgements, Judgements):
            with self._quiet:
                self.method.value = given.method
        self._judge(replace(given, names=self.names))
        if given.note:
            self.banner.show_message(f"{given.note[0].upper()}{given.note[1:]}. {self.advice}".strip())

    def _refuse_others(self, given: Judgements | Judges) -> None:
        if len(given.names) != len(self.names):
            raise ValueError(
                f"there are judgements for {len(given.names)} criteria; this panel has {len(self.names)} criteria"
            )

    def _typed(self, pair: Pair, words: str) -> None:
        try:
            value = typed_judgement(words)
        except ValueError as refusal:
            self._refuse(pair, f"{refusal}, and an empty box leaves it open")
        else:
            self._say(pair, value)

    def _say(self, pair: Pair, value: float) -> None:
        """Judge one pair anew; ``nan``: leave it open."""
        try:
            self._judge(self.said.judging(pair, value))
        except ValueError as refusal:
            self._refuse(pair, str(refusal))

    def _refuse(self, pair: Pair, sentence: str) -> None:
        """Say why a judgement cannot be, and go back to the last one that could."""
        self._place(pair)
        first, second = (self.names[k] for k in pair)
        self.banner.show_message(f"The judgement of {first} against {second} stays as it was: {sentence}.")

    def _judge(self, judgements: Judgements) -> None:
        with self.held():
            self.said = replace(judgements, method=self.method.value)
            self.given = self._together()
            self.judgements = self.given.judgements if isinstance(self.given, Judges) else self.given
            for pair in self.sliders:
                self._place(pair)
            self._show()
        self._tell_followers()

    def _together(self) -> Judgements | Judges:
        """All that was judged, as it goes to a file."""
        return self.said

    def _place(self, pair: Pair) -> None:
        """Slider and box of a pair show its judgement, or what the others imply."""
        value, slider = self.said.array[pair], self.sliders[pair]
        options = sorted({*SAATY_SCALE} if math.isnan(value) else {*SAATY_SCALE, value}, reverse=True)
        slider.pale = math.isnan(value)
        with self._quiet:
            slider.offer(
                [(as_fraction(v), v) for v in options], _nearest(options, float(self.said.complete().array[pair]))
            )
            self.boxes[pair].value = "" if math.isnan(value) else as_fraction(value)

    def _show(self) -> None:
        self.picture.show(self.given)
        self.numbers.put(("", *self.names, "weight"), self._matrix())
        self.banner.show_message(self.advice)

    @property
    def advice(self) -> str:
        """What to look at again when the judgements contradict each other; empty when they do not."""
        ratio = self.said.consistency_ratio
        if ratio <= 0.1:
            return ""
        worst = self.said.worst
        named = {f"{self.names[i]} against {self.names[j]}": (i, j) for i, j in worst}
        first, *others = named
        said, implied = as_fraction(self.said.array[named[first]]), two_digits(worst[named[first]])
        look = f"{first}: {said} was said, the {'rest implies' if others else 'others imply'} about {implied}"
        advice = (
            f"Each of {', '.join(named)} may be the one that is off; take {look}" if others else f"Look again at {look}"
        )
        return f"The judgements contradict each other (consistency ratio {ratio:.2f}, above 0.10). {advice}."

    def _matrix(self) -> list[tuple[object, ...]]:
        named = enumerate(zip(self.names, self.said.weights, strict=True))
        return [(name, *self._matrix_row(i), bold(f"{weight:.4f}")) for i, (name, weight) in named]

    def _matrix_row(self, i: int) -> list[str]:
        """A row of the matrix; what nobody has judged is in brackets, as the others imply it."""
        cells = zip(self.said.array[i], self.said.complete().array[i], strict=True)
        return [f"({c:.2g})" if math.isnan(v) else as_fraction(v) for v, c in cells]

    def summary(self) -> str:
        """Weights and consistency ratio."""
        lines = [f"{name}: {weight:.4f}" for name, weight in zip(self.names, self.weights, strict=True)]
        missing = [f"not judged: {self.judgements.missing}"] if self.judgements.missing else []
        return "\n".join([*lines, f"consistency ratio: {self.judgements.consistency_ratio:.4f}", *missing])


def as_fraction(value: float) -> str:
    """``1/3`` and ``3``, as Saaty writes them, and ``2/3``; four digits of anything else."""
    whole, digits = Fraction(float(value)).limit_denominator(99), f"{value:.4g}"
    exact = abs(float(whole) - value) < 1e-9 and (1 in (whole.numerator, whole.denominator) or float(digits) != value)
    return str(whole) if exact else digits


def two_digits(value: float) -> str:
    """Two digits of a judgement, below 1 as ``1/81``."""
    there, back = (float(f"{v:.2g}") for v in (value, 1 / value))
    return f"1/{back:g}" if back > 1 else f"{there:g}"


def _nearest(options: Sequence[float], value: float) -> float:
    return min(options, key=lambda option: abs(option - value))


def ahp_panel(judgements: Judgements | Judges, title: str = "") -> AhpPanel:
    """Sliders and boxes for pairwise judgements: "the left matters 5 times as much as the right".

    The result's ``.judgements`` and their ``.weights`` feed the next cell.  Of several judges (see `group`) one after
    the other is shown, and these are the group's.
    """
    refuse_arguments(ahp_panel, locals())
    if isinstance(judgements, Judges):
        from .judges import JudgesPanel

        return JudgesPanel(judgements, title)
    return AhpPanel(judgements, title)
