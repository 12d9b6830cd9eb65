"""What every design shares: its numbers are checked, can be replaced, and show as a table."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import Field, fields
from typing import Any, ClassVar, NamedTuple, Protocol, Self, TypeVar, runtime_checkable

import numpy as np

from .declaration import Choice, Declared, Quantity, declarations
from .kinds import columns, kind_words, refuse_kinds, refuse_lengths, shown
from .markup import Html, html, letters, table, words
from .measure import Measure
from .tree import a_design, choices_of, declared_in, label, value_of, with_quantities

Kind = TypeVar("Kind")


@runtime_checkable
class Analysable(Protocol):
    """A design that can be analysed, such as a cam."""

    __dataclass_fields__: ClassVar[dict[str, Field[Any]]]

    def analyse(self, at: Any = ..., /) -> Any:
        """Everything that follows from the design, at so many positions or at these."""
        ...


D = TypeVar("D", bound=Analysable)
"""The kind of design that a study is of, and so its front and its minimum."""


def refuse_unanalysable(design: object, what: str) -> None:
    """``ValueError`` in a sentence for what is neither a design nor a population of designs."""
    if not isinstance(design, Analysable) or isinstance(design, type):
        raise ValueError(f"{what} is {shown(design)}; it must be a design that can be analysed, such as a cam")


def refuse_design(design: object, what: str) -> None:
    """``ValueError`` in a sentence for what is not one design: a class of designs, a population, or something else."""
    refuse_unanalysable(design, what)
    refuse_population(design, what)


def refuse_no_cam(cam: object, machine: type) -> None:
    """``ValueError`` in a sentence for the cam of a kind of ``machine`` that is none, or such a machine already."""
    refuse_unanalysable(cam, "the cam")
    inside: object = cam
    while inside is not None:
        if isinstance(inside, machine):
            kind = kind_words(machine, article=True)
            raise ValueError(f"the cam has all that {kind} has already; it must be a cam without that")
        inside = getattr(inside, "cam", None)


def refuse_population(thing: object, what: str) -> None:
    """``ValueError`` in a sentence for a population of designs, or what holds one, such as its analysis."""
    for part in (thing, *getattr(thing, "__dict__", {}).values()):
        if isinstance(part, Declared) and columns(part):
            raise ValueError(f"{what} is a population, {shown(part)} with columns; it must be one design")


def with_more(thing: Kind, kind_of: Callable[[Any], Callable[..., Kind]], **more: object) -> Kind:
    """A ``thing`` that holds ``more`` besides, of the kind that follows from its own: an analysis with a motor."""
    given = {f.name: getattr(thing, f.name) for f in fields(thing)}  # type: ignore[arg-type]
    return kind_of(type(thing))(**given, **more)


class Conversion(NamedTuple):
    """What a design can be made into at one stroke: each of its ``conversions`` is a button of a panel.

    They are the same for all designs that differ in their quantities alone.
    """

    name: str
    """On the button."""
    part: str
    """The path of what changes: the button stands by its quantities."""
    meaning: str
    """In a sentence."""
    make: Callable[[], tuple[Analysable, str]]
    """Gives that design, and what is to be said of it, if anything; ``ValueError`` where it cannot be."""


class Design(Declared):
    """What every design shares: its numbers are checked, can be replaced, and show as a table."""

    measures: ClassVar[tuple[Measure, ...]] = ()
    """Every measure of all such designs, for tables and files (see `measures_of`)."""
    makers: ClassVar[Mapping[str, Callable[..., Measure]]] = {}
    """Functions that make further measures of numbers and words, by the names that `Measure.made` gives them."""
    answers_for: ClassVar[tuple[str, ...]] = ()
    """Parts that are analysed on their own, and whose measures its own analysis answers as well."""

    def __post_init__(self) -> None:
        super().__post_init__()
        refuse_kinds(self, declarations(self))
        refuse_lengths(self)

    def ready_for(self, paths: Iterable[str]) -> Self:
        """The same design, made so that the quantities at ``paths`` can vary from where they stand.

        Where it lacks one because of what is chosen, it gets the option that has it and can be made ``around`` the
        chosen one: in place of a plain motion law that law as coefficients shape it, all of them 0.  A design with a
        number that stands for "whatever is needed" says here what it becomes.  Parts that it answers for come first.
        """
        refuse_population(self, "the design")
        wanted = {*paths}
        for name in self.answers_for:
            part: Design = getattr(self, name)
            ready = part.ready_for([path.removeprefix(f"{name}.") for path in wanted if path.startswith(f"{name}.")])
            if ready is not part:
                return self.replace(**{name: ready}).ready_for(wanted)
        lacking = wanted - declared_in(self).keys()
        made = {}
        for path, choice in choices_of(self).items() if lacking else ():
            names = {lacked.removeprefix(f"{path}.") for lacked in lacking if lacked.startswith(f"{path}.")}
            chosen = value_of(self, path)
            for option in choice.options if names and isinstance(chosen, Declared) else ():
                if hasattr(option, "around") and names <= declared_in(option).keys():
                    made[path] = option.around(chosen)
        return with_quantities(self, made) if made else self

    def _repr_mimebundle_(self, **wanted: object) -> dict[str, str]:
        """In a notebook: declared numbers in their units, six digits, as a table and as plain text."""
        told = (f"{label(path, d)} {_shown(value_of(self, path), d)}" for path, d in declared_in(self).items())
        return {"text/plain": f"{type(self).__name__}: {', '.join(told)}", "text/html": self._repr_html_()}

    def _repr_html_(self) -> str:
        rows = [
            (
                _left(label(path, d)),
                html("<i>{}</i>", letters(d.symbol)),
                _shown(value_of(self, path), d),
                _left(d.meaning),
            )
            for path, d in declared_in(self).items()
        ]
        return table((), rows, type(self).__name__)


def measures_of(design: object) -> tuple[Measure, ...]:
    """Every measure of a design: those of all of its kind, and those of the parts that it holds, such as a contact.

    >>> from camkit.cam import ContactPair, TranslatingRollerCam
    >>> [measure.name for measure in measures_of(TranslatingRollerCam(contact=ContactPair()))][-2:]
    ['surplus work of the cam torque', 'peak contact pressure']
    """
    return (*getattr(type(design), "measures", ()), *_measures_below(a_design(design)))


def _measures_below(part: Declared) -> Iterator[Measure]:
    """Those of the parts that it holds; what is analysed on its own, such as a cam of a pair, keeps its own."""
    for name, held in part.branches().items():
        own = hasattr(held, "analyse") and name not in getattr(part, "answers_for", ())
        yield from () if own else getattr(type(held), "measures", ())
        yield from _measures_below(held)


def refuse_unmeasured(design: object, measures: Iterable[Measure], what: str) -> None:
    """``ValueError`` in a sentence for a measure of a part that a choice of ``design`` offers and is not chosen."""
    lacking = {(measure.whole or measure).function: measure for measure in measures}
    for measure in measures_of(design):
        lacking.pop(measure.function, None)
    for path, declared in choices_of(design).items() if lacking else ():
        for name, option in declared.named.items():
            of_option = () if hasattr(option, "analyse") else getattr(type(option), "measures", ())
            for measure in (m for m in of_option if m.function in lacking):
                now = declared.text(value_of(design, path))
                raise ValueError(
                    f"the {measure.name} does not apply to {what}: the {words(path)} is {now}; it must be {name}"
                )


def _left(text: str) -> Html:
    """A cell whose text begins at its left edge."""
    return html("<div style='text-align:left'>{}</div>", text)


def _shown(value: Any, declared: Quantity | Choice) -> str:
    if isinstance(declared, Quantity) and np.ndim(value):
        return f"{np.size(value)} values in {declared.unit}"
    return declared.text(value)
