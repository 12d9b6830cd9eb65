"""Why parts of a design fail: which limit most of them miss, and which tolerance is behind it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..quantities import words
from ..quantities.kinds import refuse_arguments
from ..quantities.types import Array
from .robust import RobustStudy
from .spread import Source
from .study import KEPT

PLAIN = 0.01
"""By so much, as a share of the parts, one tolerance has to raise the yield to be named."""


@dataclass(frozen=True)
class Failures:
    """What becomes of the parts of ``p`` designs of ``study``, by the models of its limits."""

    study: RobustStudy
    missed: Array
    """The share of the parts that miss each limit, ``(p, n_limits)``."""
    share: Array
    """The yield, ``(p,)``."""
    without: Array
    """The yield if one of the tolerances were 0, ``(p, n_tolerances)``."""

    def __str__(self) -> str:
        missed, without = self.missed.mean(0), self.without.mean(0)
        if not missed.any():
            return "no part misses a limit"
        if not self.study.limits:
            return f"{_per_cent(missed[0])} of the parts cannot be built"
        worst, cause = int(missed.argmax()), int(without.argmax())
        measure, value, sense = self.study.limits[worst]
        limit = f"{measure.name} ({'at most' if sense > 0 else 'at least'} {measure.text(value)})"
        said = f"{_per_cent(missed[worst])} of the parts miss the limit of the {limit}, more than any other; "
        if without[cause] < self.share.mean() + PLAIN:
            return f"{said}no single tolerance is behind it"
        tolerance = words(self.study.names[cause])
        return f"{said}without the tolerance of the {tolerance} {_per_cent(without[cause])} would keep every limit"


def _per_cent(share: float) -> str:
    return f"{100 * share:.1f} %"


def tolerance_texts(study: RobustStudy) -> list[str]:
    """The tolerances of the start of a study, by name.

    >>> from camkit import mm, shaft_study
    >>> tolerance_texts(shaft_study().under({"outer_diameter": 0.5 * mm, "inner_diameter": (0, 0.3 * mm)}))
    ['outer diameter ±0.5 mm', 'inner diameter 0 mm to 0.3 mm']
    """
    (middle,), (half,) = study._half(study._base(study.x0[None]))
    told = []
    for key, name, c, t in zip(study.tolerances, study.names, middle, half, strict=True):
        declared = study._parts.declared[key.moves[0][0] if isinstance(key, Source) else key]
        low, high = declared.text(c - t), declared.text(c + t)
        told.append(f"{words(name)} {f'±{high}' if c == 0 else f'{low} to {high}'}")
    return told


def failures(study: RobustStudy, x: ArrayLike) -> Failures:
    """Why parts of designs ``(p, n_free)`` fail.

    >>> from camkit import mm, shaft_study
    >>> robust = shaft_study().under({"outer_diameter": 0.5 * mm, "inner_diameter": 0.3 * mm})
    >>> failures(robust, [[0.1295, 0.103]]).without.round(2).tolist()
    [[1.0, 0.81]]
    """
    refuse_arguments(failures, locals())
    models, z = study.models(study.rows(x)), study.shares()

    def kept(shares: Array) -> Array:
        return np.stack([model.at(shares) <= KEPT for model in models])

    one_out = [z * (np.arange(z.shape[1]) != j) for j in range(z.shape[1])]
    without = np.stack([kept(shares).all(0).mean(-1) for shares in one_out], axis=-1)
    return Failures(study, 1 - kept(z).mean(-1).T, kept(z).all(0).mean(-1), without)
