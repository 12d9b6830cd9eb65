"""`judge`: pairwise judgements under sliders, their weights and consistency at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from itertools import combinations
from typing import Any

import ipywidgets as w
import numpy as np

from ..decision import SAATY_SCALE, ahp, judgement_matrix
from ..plot.front import weight_bars
from .controls import banner, tell
from .panel import Panel
from .picture import LivePicture


class Judgements(Panel):
    """Saaty's judgements among ``names``, one slider from 1/9 to 9 for each pair.

    ``weights`` and ``judgement`` follow at once; ``on_change(f)`` calls ``f()`` after every change.
    """

    def __init__(self, names: Sequence[str], judgements: Any, title: str = "") -> None:
        self.names = tuple(names)
        self.start = judgement_matrix(judgements)
        if len(self.start) != len(self.names):
            raise ValueError(f"there are {len(self.start)} rows of judgements for {len(self.names)} criteria")
        self.judgement = ahp(self.start)
        self._followers: list[Callable[[], None]] = []
        self._silent = False
        pairs = list(combinations(range(len(self.names)), 2))
        self.sliders = {(i, j): self._slider(self.start[i, j]) for i, j in pairs}
        self.picture = LivePicture(
            (weight_bars,), f"Weights of {', '.join(names)}", width=7.2, height=0.9 + 0.5 * len(names)
        )
        self._matrix, self._banner = w.HTML(), banner()
        reset = w.Button(description="Reset", icon="undo", tooltip="back to the judgements that the panel began with")
        reset.on_click(lambda _: self.load(self.start))
        rows = [self._row(pair) for pair in pairs]
        left = w.VBox([*rows, reset, self._banner, self._matrix], layout=w.Layout(flex="1 1 430px"))
        right = w.Box([self.picture.widget], layout=w.Layout(flex="1 1 420px", max_width="720px"))
        body = w.HBox([left, right], layout=w.Layout(flex_flow="row wrap", align_items="flex-start"))
        super().__init__([w.HTML(f"<b>{title}</b>"), body])
        self._show()

    def _slider(self, value: float) -> w.SelectionSlider:
        options = sorted({*SAATY_SCALE, float(value)})
        slider = w.SelectionSlider(
            options=[(_fraction(v), v) for v in options], value=_nearest(options, value), layout=w.Layout(width="190px")
        )
        slider.observe(lambda _: self._changed(), "value")
        return slider

    def _row(self, pair: tuple[int, int]) -> w.Widget:
        first, second = (w.HTML(self.names[k], layout=w.Layout(flex="0 0 118px")) for k in pair)
        first.add_class("camkit-right")
        return w.HBox([first, self.sliders[pair], second], layout=w.Layout(align_items="center"))

    @property
    def weights(self) -> np.ndarray:
        """The weights of the criteria."""
        return self.judgement.weights

    @property
    def upper(self) -> list[float]:
        """The judgements as the matrix's upper triangle, row by row."""
        return [float(slider.value) for slider in self.sliders.values()]

    def load(self, judgements: Any) -> None:
        """Show other judgements (matrix or upper triangle)."""
        matrix = judgement_matrix(judgements)
        if len(matrix) != len(self.names):
            raise ValueError(
                f"there are judgements for {len(matrix)} criteria; this panel has {len(self.names)} criteria"
            )
        self._silent = True
        try:
            for (i, j), slider in self.sliders.items():
                values = sorted({*SAATY_SCALE, float(matrix[i, j])})
                slider.options = [(_fraction(v), v) for v in values]
                slider.value = _nearest(values, matrix[i, j])
        finally:
            self._silent = False
        self._changed()

    def on_change(self, act: Callable[[], None]) -> None:
        """Call ``act()`` after every change of a judgement."""
        self._followers.append(act)

    def _changed(self) -> None:
        if self._silent:
            return
        self.judgement = ahp(self.upper)
        self._show()
        for act in self._followers:
            act()

    def _show(self) -> None:
        self.picture.show((self.names, self.judgement))
        self._matrix.value = self._matrix_html()
        tell(self._banner, self.advice)

    @property
    def advice(self) -> str:
        """What to look at again when the judgements contradict each other; empty when they do not."""
        judgement = self.judgement
        if judgement.consistency_ratio <= 0.1:
            return ""
        i, j = judgement.worst
        implied = judgement.weights[i] / judgement.weights[j]
        return (
            f"The judgements contradict each other (consistency ratio {judgement.consistency_ratio:.2f}, above 0.10). "
            f"Look again at {self.names[i]} against {self.names[j]}: {_fraction(judgement.matrix[i, j])} was said, "
            f"the others imply about {implied:.2g}."
        )

    def _matrix_html(self) -> str:
        head = "".join(f"<th>{name}</th>" for name in self.names)
        rows = "".join(
            f"<tr><td>{name}</td>{''.join(f'<td>{_fraction(v)}</td>' for v in row)}<td><b>{weight:.4f}</b></td></tr>"
            for name, row, weight in zip(self.names, self.judgement.matrix, self.weights, strict=True)
        )
        return f"<div class='camkit-tables'><table><tr><th></th>{head}<th>weight</th></tr>{rows}</table></div>"

    def summary(self) -> str:
        """Weights and consistency ratio."""
        lines = [f"{name}: {weight:.4f}" for name, weight in zip(self.names, self.weights, strict=True)]
        return "\n".join([*lines, f"consistency ratio: {self.judgement.consistency_ratio:.4f}"])


def _fraction(value: float) -> str:
    whole = Fraction(float(value)).limit_denominator(99)
    return str(whole) if abs(float(whole) - value) < 1e-9 else f"{value:.3g}"


def _nearest(options: Sequence[float], value: float) -> float:
    return min(options, key=lambda option: abs(option - value))


def judge(names: Sequence[str], judgements: Any, title: str = "") -> Judgements:
    """Sliders for pairwise judgements among ``names``: "the left matters 5 times as much as the right".

    ``judgements`` is a reciprocal matrix or its upper triangle row by row.  The result's ``.weights`` feed the
    next cell.
    """
    return Judgements(names, judgements, title)
