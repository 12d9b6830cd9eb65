"""Docstrings are written for people who read the code: what reStructuredText would take for markup is shielded here.

Of a class that declares quantities the page shows them as a table would: symbol, default, range and meaning.
"""

import dataclasses
import inspect
import re

from sphinx.application import Sphinx

from camkit.quantities import Choice, Quantity, declarations

LITERAL = re.compile(r"(``.*?``)")


def finish(app: Sphinx, what: str, name: str, thing: object, options: object, lines: list[str]) -> None:
    """A bar, as in |x|, stays a bar; behind the docstring of a class stand its quantities."""
    lines[:] = [line if line.lstrip().startswith((">>>", "...")) else shielded(line) for line in lines]
    if what == "class" and (rows := [*quantities(thing)]):
        lines += ["", *rows, ""]


def shielded(line: str) -> str:
    return "".join(
        part if LITERAL.fullmatch(part) else re.sub(r"(?<!\\)\|", r"\|", part) for part in LITERAL.split(line)
    )


def declared(thing: type) -> dict[str, Quantity | Choice]:
    """The quantities and choices that a class declares; none of what is no design."""
    return declarations(thing) if dataclasses.is_dataclass(thing) else {}


def quantities(thing: type) -> list[str]:
    """What a class declares, one line each."""
    return [f":param {name}: {line(said)}" for name, said in declared(thing).items()]


def line(said: Quantity | Choice) -> str:
    """A declaration as a sentence: meaning, symbol, default and what a slider offers; or the options."""
    meaning = re.sub(r"([*`\\|])", r"\\\1", said.meaning)
    if not isinstance(said, Quantity):
        return f"{meaning}; one of: {', '.join(map(str, said.named))}"
    offered = f"{said.low:g} to {said.high:g} {said.unit}".rstrip()
    return f"{meaning}: ``{said.symbol}``, {said.default:g} {said.unit}".rstrip() + f", slider {offered}"


def plainly(app: Sphinx, what: str, name: str, thing: object, options: object, said: str, gives: str) -> tuple | None:
    """Of what declares its quantities the names alone: their defaults in SI are no numbers that people know."""
    if what != "class" or not declared(thing):
        return None
    return f"({', '.join(inspect.signature(thing).parameters)})", None


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("autodoc-process-docstring", finish)
    app.connect("autodoc-process-signature", plainly)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
