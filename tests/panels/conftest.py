"""What the tests of panels share: what the page of a design computes is recorded once, for all of them in a process."""

from __future__ import annotations

from collections.abc import Hashable, Iterator, Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any

import pytest

from camkit.panels import instrument
from camkit.render.living import Living, living

PAGES = 24
"""So many are remembered, ten megabytes each."""


@lru_cache(PAGES)
def _recorded(design: Any, views: Any, measures: Any, *more: Any) -> tuple[Living, dict[str, Any]]:
    """The page of a design, and what it knows once it is recorded."""
    made = living(design, views, measures, **{name: dict(value) if pairs else value for name, pairs, value in more})
    return made, {name: getattr(made, name) for name in ("_recorded", "structure", "packed")}


def recorded_once(design: Any, views: Any, measures: Any, **more: Any) -> Living:
    """What `living` gives: of equal designs, measures and limits, and the same views, it computes the same."""
    try:
        found, known = _recorded(design, views, measures, *(_hashable(name, value) for name, value in more.items()))
    except TypeError:  # a design that holds what has no hash
        return living(design, views, measures, **more)
    made = replace(found, design=design)
    made.__dict__.update(known)
    return made


def _hashable(name: str, value: Any) -> tuple[str, bool, Hashable]:
    if isinstance(value, Mapping):
        return name, True, tuple(value.items())
    return name, False, tuple(value) if isinstance(value, list) else value


@pytest.fixture(autouse=True)
def _pages_are_recorded_once(request: pytest.FixtureRequest) -> Iterator[None]:
    """But where a test puts something else in the place of what is computed or recorded."""
    with pytest.MonkeyPatch.context() as patch:
        if "monkeypatch" not in request.fixturenames:
            patch.setattr(instrument, "living", recorded_once)
        yield
