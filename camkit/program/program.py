"""A program: what plain numpy code does to its inputs, call by call, to be run again on others."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..quantities import D, quantities_of, unremarked, value_of, with_quantities
from ..quantities.types import Array
from .record import CannotRecord, Recorded, Recording, uncollected
from .texts import Template, filled, numbers


@dataclass(frozen=True, eq=False)
class Program:
    """Calls of numpy in a straight line, from inputs to outputs, both by name.

    >>> area = recorded(lambda size: {"area": size["width"] * size["height"]}, {"width": 2.0, "height": 3.0})
    >>> area({"width": 4.0, "height": 5.0})
    {'area': np.float64(20.0)}
    """

    calls: tuple[Recorded, ...]
    """Inputs first, in order; of those that follow each needs only what stands before it."""
    inputs: tuple[str, ...]
    outputs: Mapping[str | int, Recorded | np.ndarray]
    """Of each output its call, or what it is whatever the inputs are; what texts need, by its number."""
    texts: Mapping[str, Template] = field(default_factory=dict)
    """Outputs that are texts, in parts."""
    refusals: Mapping[int, Template] = field(default_factory=dict)
    """In order the numbers of what must hold of one design, and the sentence that refuses it if one does not."""

    def __call__(self, inputs: Mapping[str, ArrayLike]) -> dict[str, Any]:
        """The outputs of other inputs, of the same shapes as those that it was recorded with; texts come last."""
        results = self._results(inputs)
        outputs = {name: out for name, out in self.outputs.items() if isinstance(name, str)}
        found = {name: results[out.number] if isinstance(out, Recorded) else out for name, out in outputs.items()}
        return found | {name: filled(template, results) for name, template in self.texts.items()}

    def refusal(self, inputs: Mapping[str, ArrayLike]) -> str:
        """The sentence that refuses one design of other inputs; empty if it can be built.

        >>> from camkit.quantities import unless
        >>> def wide(given):
        ...     if refuse := unless(given["x"] > 0):
        ...         refuse(f"the width is {given['x']:.1f}; it must be above 0")
        ...     return {}
        >>> program = recorded(wide, {"x": 1.0})
        >>> program.refusal({"x": 2.0}), program.refusal({"x": -2.0})
        ('', 'the width is -2.0; it must be above 0')
        """
        results = self._results(inputs)
        return next((filled(sentence, results) for ok, sentence in self.refusals.items() if not results[ok]), "")

    def _results(self, inputs: Mapping[str, ArrayLike]) -> dict[int, Array]:
        results: dict[int, Array] = {}
        for k, (name, call) in enumerate(zip(self.inputs, self.calls, strict=False)):
            value = np.asarray(inputs[name], dtype=float)[()]
            if value.shape != call.shape:
                raise ValueError(f"the input {name} has the shape {value.shape}; it must have {call.shape}")
            results[k] = value
        with np.errstate(all="ignore"):
            for k in self.needed:
                results[k] = self.calls[k].result(results)
        return results

    @property
    def of_numbers(self) -> Program:
        """The same without its texts and what its inputs would be refused for."""
        outputs: dict[str | int, Recorded | np.ndarray] = {
            name: out for name, out in self.outputs.items() if isinstance(name, str)
        }
        return replace(self, outputs=outputs, texts={}, refusals={})

    @cached_property
    def needed(self) -> list[int]:
        """The numbers of the calls that outputs depend on, in order, without the inputs."""
        found = {out.number for out in self.outputs.values() if isinstance(out, Recorded)}
        for call in reversed(self.calls):
            if call.number in found:
                found.update(numbers_in(call.arguments))
        return sorted(k for k in found if k >= len(self.inputs))


def numbers_in(arguments: Sequence[object]) -> Iterator[int]:
    """The calls whose results are among arguments."""
    for x in arguments:
        if isinstance(x, Recorded):
            yield x.number
        elif isinstance(x, (tuple, list)):
            yield from numbers_in(x)


def recorded(function: Callable[[dict[str, Any]], Mapping[str, object]], inputs: Mapping[str, ArrayLike]) -> Program:
    """What ``function`` does to inputs by name, as a program; its outputs are arrays by name.

    ``inputs`` are numbers or arrays that stand for all others of their shapes.  `CannotRecord` where it asks for what
    is not known before the program runs.
    """
    recording = Recording()
    given = {name: recording.input(value) for name, value in inputs.items()}
    try:
        with unremarked(), np.errstate(all="ignore"), uncollected():
            outputs = function(given)
    except Exception as error:
        if why := unrecorded(error):
            raise why from error
        raise
    texts = {name: recording.texts.parted(value) for name, value in outputs.items() if isinstance(value, str)}
    arrays = {name: value for name, value in outputs.items() if name not in texts}
    found: dict[str | int, Recorded | np.ndarray] = {
        name: value if isinstance(value, Recorded) else np.asarray(value) for name, value in arrays.items()
    }
    needed = (*recording.refusals, *(k for t in (*recording.refusals.values(), *texts.values()) for k in numbers(t)))
    found |= {k: recording.calls[k] for k in needed}
    recording.close()
    return Program(tuple(recording.calls), tuple(inputs), found, texts, recording.refusals)


def unrecorded(error: BaseException) -> CannotRecord | None:
    """What cannot be recorded, if that is behind an error: numpy and others put their own before it."""
    behind: BaseException | None = error
    while behind and not isinstance(behind, CannotRecord):
        behind = behind.__cause__ or behind.__context__
    return behind if isinstance(behind, CannotRecord) else None


def record(
    function: Callable[..., Mapping[str, object]], design: D, more: Mapping[str, float] | None = None, rows: int = 0
) -> Program:
    """What ``function(design, **more)`` gives, as a program of all quantities of the design, by path, and ``more``.

    What is chosen from a menu stays as it is.  The program is of one design or, with ``rows``, of so many at once, each
    quantity a column ``(rows, 1)``.  What one design would be refused for makes its outputs ``nan``.

    >>> from camkit import TranslatingRollerCam
    >>> size = record(lambda cam: {"start height": cam.start_height}, TranslatingRollerCam())
    >>> start = {path: value_of(TranslatingRollerCam(), path) for path in size.inputs}
    >>> print(f"{size(start | {'base_radius': 0.05, 'offset': 0.0})['start height']:.3f} m")
    0.058 m
    """
    extra = dict(more or {})
    start = {path: value_of(design, path) for path in quantities_of(design)} | extra
    inputs = {name: np.full((rows, 1), value) if rows else value for name, value in start.items()}

    def of_design(given: dict[str, object]) -> Mapping[str, object]:
        paths = {name: value for name, value in given.items() if name not in extra}
        return function(with_quantities(design, paths), **{name: given[name] for name in extra})

    return recorded(of_design, inputs)
