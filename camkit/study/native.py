"""What a study says of many designs, by native code where that is there: numpy answers until it is, and if it is not.

Both say the same to the last bit, so that no search comes to another end.  The code knows every declared number of the
start as an input, so that it serves for all studies that differ in these.
"""

from __future__ import annotations

import dataclasses
import os
import threading
from collections import OrderedDict
from collections.abc import Hashable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from functools import cache, cached_property
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from ..program import recorded
from ..quantities import Quantity, quantities_of, unremarked, value_of, with_quantities
from ..quantities.tree import Paths
from ..quantities.types import Array
from .likeness import foreign, likeness, read_by

if TYPE_CHECKING:
    from ..program.kernel import Kernel
    from .study import Study

WORTH = 2048
"""After so many designs it is worth making code for those that follow."""
BLOCK = 64
"""So many designs numpy takes at once."""
MOST = 32
"""So many programs have their code, those that were last asked for."""


class Asked(Protocol):
    """What can be asked of an analysis of ``p`` designs: numbers ``(p,)`` of each, such as a measure, or ``(p, n)``."""

    def of(self, analysis: object, p: int, /) -> Array:
        """What the analysis says."""


_MADE_FIRST = ContextVar("_MADE_FIRST", default=False)


@contextmanager
def made_first() -> Iterator[None]:
    """A context in which native code is made before it is first asked: there are more designs than it takes time."""
    token = _MADE_FIRST.set(True)
    try:
        yield
    finally:
        _MADE_FIRST.reset(token)


class Native:
    """The code for all studies that differ in declared numbers alone; made beside while numpy answers."""

    def __init__(self) -> None:
        self.kernel: Kernel | None = None
        self.refused = ""
        """Why there is none and will be none."""
        self._seen, self._lock = 0, threading.Lock()
        self._maker: threading.Thread | None = None

    def __reduce__(self) -> tuple[type[Native], tuple[()]]:
        return Native, ()

    def seen(self, answers: Answers, x: Array) -> None:
        """Note that numpy has answered for designs; after enough of them the code begins to be made."""
        self._seen += len(x)
        if self._seen > WORTH:
            self.make(answers, x)

    def make(self, answers: Answers, x: Array) -> None:
        """Begin to make the code, if nobody has begun; it is compared with numpy at designs ``x``."""
        with self._lock:
            if self._maker is None and not _FORKED:
                self._maker = threading.Thread(target=self._make, args=(answers, x[:BLOCK].copy()), daemon=True)
                self._maker.start()

    @property
    def begun(self) -> bool:
        """Whether it is being made, or was."""
        return self._maker is not None

    def wait(self) -> None:
        """Until the code is there, or there will be none."""
        if self._maker is not None:
            self._maker.join()

    def _make(self, answers: Answers, x: Array) -> None:
        try:
            with _MAKING:  # one after the other, so that a search is not slowed by many
                kernel = made(answers.study, answers.paths, answers.asked)
            agrees(kernel(answers.numbers, x), answers.by_numpy(x))
            self.kernel = kernel
        except Exception as why:  # whatever it is, numpy answers
            self.refused = f"{type(why).__name__}: {why}"


class Answers:
    """What the analyses of a study say of designs that differ at some ``paths``: its measures, or what is ``asked``."""

    def __init__(self, study: Study[Any], paths: tuple[str, ...], asked: Sequence[Asked] | None = None) -> None:
        self.study, self.paths = study, paths
        self.asked = study.measures if asked is None else tuple(asked)
        self.native = native(study, paths, self.asked)
        self._read = self._reads()

    def __call__(self, x: Array) -> Array:
        """What they say of values ``(p, n)``, side by side, ``(p, n_measures)``."""
        found = self.by_code(x)
        return self.by_numpy(x) if found is None else found

    def by_code(self, x: Array) -> Array | None:
        """The same by native code, if that is there by now."""
        if self._read and self._reads() != self._read:  # such as a variable of a notebook
            self.native, self._read = native(self.study, self.paths, self.asked), self._reads()
        if self.native is None or not len(x):
            return None
        if self.native.kernel is None and _MADE_FIRST.get():
            self.native.make(self, x)
            self.native.wait()
        if self.native.kernel is not None:
            return self.native.kernel(self.numbers, x)
        self.native.seen(self, x)
        return None

    def __getstate__(self) -> dict[str, object]:
        return {**vars(self), "_read": self._read and (0,)}  # functions are read anew

    def _reads(self) -> tuple[Hashable, ...]:
        """What a user's functions read now; nothing where no native code depends on it."""
        with suppress(TypeError):
            return () if self.native is None else _read(self.study, self.asked)
        return (object(),)

    @cached_property
    def numbers(self) -> dict[str, float]:
        """Every declared number of the start."""
        paths = quantities_of(self.study.start)
        return dict(zip(paths, Paths(self.study.start, paths).values(self.study.start), strict=True))

    @cached_property
    def _paths(self) -> Paths:
        return Paths(self.study.start, self.paths, Quantity)

    @cached_property
    def ends(self) -> list[int]:
        """Where what is asked ends, of what stands side by side; but for the last, as ``np.split`` takes it."""
        start = np.array([self._paths.values(self.study.start)], dtype=float)
        return np.cumsum([told.shape[1] for told in self._told(start)])[:-1].tolist()

    def by_numpy(self, x: Array) -> Array:
        """The same by numpy, in blocks of designs that stay near the processor."""
        return np.concatenate([np.hstack(self._told(x[k : k + BLOCK])) for k in range(0, max(len(x), 1), BLOCK)])

    def _told(self, x: Array) -> list[Array]:
        with unremarked():
            designs = self._paths.put(self.study.start, [np.ascontiguousarray(column)[:, None] for column in x.T])
        analysis = self.study.analysis_of(designs)
        return [one if one.ndim > 1 else one[:, None] for one in (each.of(analysis, len(x)) for each in self.asked)]


def made(study: Study[Any], paths: Sequence[str], asked: Sequence[Asked] | None = None) -> Kernel:
    """The code for what a study's measures, or what is ``asked``, say of designs that differ at some paths."""
    from ..program.kernel import Kernel

    def measured(given: dict[str, Any]) -> Mapping[str, object]:
        analysis = study.analysis_of(with_quantities(study.start, given))
        return {str(i): each.of(analysis, 1) for i, each in enumerate(study.measures if asked is None else asked)}

    # Columns where designs differ, as numpy has them: of a design that cannot be built these alone become nan.
    start = {path: value_of(study.start, path) for path in quantities_of(study.start)}
    return Kernel(recorded(measured, {k: np.full((1, 1), v) if k in paths else v for k, v in start.items()}), paths)


def agrees(found: Array, expected: Array) -> None:
    """``ArithmeticError`` where code and numpy differ in one bit of a number."""
    bits = [np.ascontiguousarray(each).view(np.int64) for each in (found, expected)]
    same = (bits[0] == bits[1]) | (np.isnan(found) & np.isnan(expected))
    if not same.all():
        raise ArithmeticError(f"native code and numpy differ in {(~same).sum()} numbers")


KNOWN: OrderedDict[Hashable, Native] = OrderedDict()
"""By what studies have in common, what was last asked for last."""
_LOCK = threading.Lock()
_MAKING = threading.Lock()
_FORKED: list[bool] = []
"""Not empty in a process that was forked while code was made: LLVM may be in the midst of it, so none is made."""
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=lambda: _FORKED.extend([True] * _MAKING.locked()))


def native(study: Study[Any], paths: Sequence[str], asked: Sequence[Asked] | None = None) -> Native | None:
    """What there is for studies like this one; none where llvmlite is not installed, or ``CAMKIT_FAST`` is 0."""
    if os.environ.get("CAMKIT_FAST") == "0" or not _installed():
        return None
    told = study.measures if asked is None else asked
    try:
        read = _read(study, told)
        key = (likeness(study.start), tuple(paths), likeness(told), study.angles, study.rough, read)
        hash(key)
    except TypeError:  # who can say what is like it
        return None
    with _LOCK:
        found = KNOWN.setdefault(key, Native())
        KNOWN.move_to_end(key)
        while len(KNOWN) > MOST:
            KNOWN.popitem(last=False)
    return found


@cache
def _installed() -> bool:
    with suppress(ModuleNotFoundError):
        return find_spec("llvmlite") is not None
    return False


def _read(study: Study[Any], asked: Sequence[Asked]) -> tuple[Hashable, ...]:
    """What the functions and the classes of a user read, those of the design and of the study itself too."""
    own: list[object] = []
    if foreign(type(study)):
        from .robust import RobustStudy

        known = {f.name for f in dataclasses.fields(RobustStudy)}
        own = [type(study), *(getattr(study, f.name) for f in dataclasses.fields(study) if f.name not in known)]
    return read_by(study.start, *asked, *own)
