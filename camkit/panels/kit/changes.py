"""A design with other values, as a panel gives them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from ...quantities import Analysable, D, Paths, quantities_of, unremarked, with_quantities


def changed(design: D, values: Mapping[str, object]) -> D:
    """``design`` with other values by path, as a panel gives them."""
    with unremarked():  # a panel's numbers have their units
        return with_quantities(design, values)


def with_numbers(design: D, values: Sequence[float]) -> D:
    """``design`` with these values of its quantities, in their order, as a page sends them."""
    paths = quantities_of(design)
    if len(values) != len(paths):
        raise ValueError(f"the page sends {len(values)} numbers; the design has {len(paths)}")
    return changed(design, dict(zip(paths, values, strict=True)))


def numbers_of(design: Analysable) -> dict[str, float]:
    """The value of every quantity by path, SI."""
    paths = quantities_of(design)
    return dict(zip(paths, map(float, Paths(design, paths).values(design)), strict=True))


def alike(one: Analysable, other: Analysable) -> bool:
    """Whether designs differ in their quantities alone, so that one recording is for both."""
    values = {
        path: 1.0 * value for path, value in numbers_of(other).items()
    }  # new numbers: what closes a turn follows in both
    try:
        return bool(changed(one, values) == changed(other, values))
    except ValueError:  # another make, or an array in it
        return False
