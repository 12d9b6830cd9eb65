"""How a search came closer, generation by generation."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes

from ..kinds import refuse_arguments, refuse_empty
from ..search.nsga2 import Generation
from ..units import in_unit
from .artists import BLUE, GREY, beside_title, frame, line, new


def convergence(generations: Sequence[Generation], ax: Axes) -> Axes:
    """Best and mean of the first objective in every generation of a search, designs that cannot be built left out."""
    refuse_arguments(convergence, locals())
    refuse_empty(generations, "generations")
    measure = generations[0].study.minimise[0]
    built = [g.evaluation.f[np.isfinite(g.evaluation.f[:, 0]), 0] for g in generations]
    numbers = [g.number for g in generations]
    first = new(ax)
    if first:
        frame(ax, "Convergence", "generation", measure.label)
        ax.set_xscale("log")
    for key, of, colour, width in (("mean", np.mean, GREY, 1.4), ("best", np.min, BLUE, 2.4)):
        values = in_unit(measure.sign * np.array([of(f) for f in built]), measure.unit)
        line(ax, key, numbers, values, color=colour, linewidth=width, label=key)
    if first:
        beside_title(ax)
    return ax
