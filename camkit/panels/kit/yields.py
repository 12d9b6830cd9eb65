"""The yield of what an instrument shows, for its page: modelled while a hand moves it, exact when it rests."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import ipywidgets as w
import numpy as np
import traitlets

from ...files.workshop.faults import YIELD
from ...quantities import quantities_of, value_of
from ...study.failures import failures, tolerance_texts
from ...study.robust import RobustStudy
from ...study.spread import Tolerance, iso_2768
from ...study.study import NOTHING, Study
from ...study.tolerances import LENGTHS, general_tolerances
from .changes import numbers_of
from .latest_only import Debounced, LatestOnly
from .sheet import reason

QUIET = 0.3
"""Seconds after the last change until exact parts are judged."""
NO_TOLERANCES = "the design has no size with a general tolerance; give tolerances to the instrument"


class Made(w.DOMWidget):
    """An instrument whose page tells the yield of its design within ``tolerances``; where nothing is limited, none.

    ``tolerances`` are those of `Study.under`; ``None``: the general ones (see `general_tolerances`).  A page asks to be
    told; each change is then answered from a thread of its own, and of those that wait the newest.
    """

    made = traitlets.Dict().tag(sync=True)
    """The yield in words, and of which ``values`` of which ``make`` it is; nothing where there is none."""
    tolerances: Any = traitlets.Any(None, allow_none=True)
    design: Any
    program: bytes
    structure: dict[str, Any]
    limits: Any

    def __init__(self, **traits: Any) -> None:
        self._worker = LatestOnly(lambda task: self._tell(*task))
        self._later = Debounced(lambda: self._worker.ask((self.design, self.structure["make"], True)), QUIET)
        self._told = False
        super().__init__(**traits)
        self.on_msg(lambda _, message, __: self._begin() if "made" in message else None)

    def within(self, design: Any) -> dict[Any, Any]:
        """The tolerances of a design: those that are given, or the general ones as its sizes are."""
        if self.tolerances is not None:
            return dict(self.tolerances)
        unit = {path: declared.unit for path, declared in quantities_of(design).items()}
        general = general_tolerances(design).items()
        return {path: Tolerance(iso_2768) if unit[path] in LENGTHS else half for path, half in general}

    @property
    def half_widths(self) -> dict[str, float]:
        """The tolerances of what is shown, SI, as wide to either side; without those of a `Source`."""
        paths, found = {path: t for path, t in self.within(self.design).items() if isinstance(path, str)}, {}
        for path, given in paths.items():
            made = given if isinstance(given, Tolerance) else Tolerance(given)
            low, high = made.between(path, np.array([value_of(self.design, path)]))
            found[path] = float(max(-low[0], high[0]))
        return found

    @property
    def judged(self) -> Study | None:
        """What is shown with its limits, made within the tolerances that were given; ``None``: nothing is limited."""
        if not any(self.limits.values()):
            return None
        return self._study(self.design, self.tolerances) if self.tolerances else self._limited(self.design)

    def _limited(self, design: Any) -> Study:
        return Study(design, list(quantities_of(design))[:1], (NOTHING,), **self.limits)

    def _study(self, design: Any, tolerances: Mapping[Any, Any]) -> RobustStudy:
        return self._limited(design).under(tolerances, YIELD)

    @traitlets.validate("tolerances")
    def _possible_tolerances(self, proposal: Mapping[str, Any]) -> Any:
        if proposal["value"] is not None:
            self._study(self.design, proposal["value"])
        return proposal["value"]

    # ------------------------------------------------------------ what the page is told

    def _begin(self) -> None:
        """A page wants to be told."""
        if not self._told:
            self._told = True
            self.observe(lambda _: self._follow(), ["design", "tolerances"])
        self._follow()

    def _follow(self) -> None:
        """Where the kernel draws the pictures, these come first."""
        if self.program:
            self._worker.ask((self.design, self.structure["make"], False))
        self._later.ask()

    def _tell(self, design: Any, make: str, exact: bool) -> None:
        try:
            told = self._yield_of(design, exact)
        except Exception as error:  # a mechanism of somebody's own, which may take no populations
            told = {"text": "cannot be computed", "lines": [f"Why: {reason(error)}."]}
        self.made = {**told, "values": list(numbers_of(design).values()), "make": make} if told else {}

    def _yield_of(self, design: Any, exact: bool) -> dict[str, Any]:
        tolerances = self.within(design)
        if not any(self.limits.values()) or not tolerances:
            return {}
        study = self._study(design, tolerances)
        x = study.x0[None]
        if not exact:
            share = float(study.modelled_yield(x)[0])
            return {"text": _per_cent(share), "good": share >= YIELD}
        found, why = study.recheck(x), failures(study, x)
        share, (low, high) = float(found.share[0]), 100 * found.interval[0]
        general = " (general tolerances, ISO 2768-1 m)" if self.tolerances is None else ""
        open_ = "" if found.decided[0] else f"; whether it is {100 * YIELD:g} % is not decided"
        lines = [
            f"Made within {', '.join(tolerance_texts(study))}{general}.",
            f"{found.missed[0]} of {found.parts[0]} parts miss a limit: the yield lies between {low:.1f} and "
            f"{high:.1f} %{open_}.",
            f"By the model of each limit {why}.",
        ]
        return {"text": _per_cent(share), "good": share >= YIELD, "more": f"({low:.1f} to {high:.1f})", "lines": lines}


def _per_cent(share: float) -> str:
    return f"{100 * share:.1f} %"
