"""A page for each wing with all that it lists, from the docstrings: classes, functions, measures, values."""

from __future__ import annotations

import ast
import inspect
import pkgutil
from collections.abc import Callable, Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType

from sphinx.pycode import ModuleAnalyzer

import camkit
from camkit.quantities import Measure

from .notebooks import write


def wings() -> list[str]:
    """The parts of the package, by name; each has names that are imported from it."""
    return [info.name for info in pkgutil.iter_modules(camkit.__path__) if not info.name.startswith("_")]


def public(module: ModuleType) -> list[str]:
    """What a part of the package offers: what it lists, or what it defines and does not hide."""
    return list(getattr(module, "__all__", None) or (name for name in defined(module) if name[0] != "_"))


def defined(module: ModuleType) -> Iterator[str]:
    """The functions, classes and values that the source of a module makes."""
    for node in ast.parse(inspect.getsource(module)).body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            yield node.name
        elif isinstance(node, (ast.Assign, ast.AnnAssign)):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            yield from (target.id for target in targets if isinstance(target, ast.Name))


def homes(module: ModuleType) -> dict[str, str]:
    """The module that each name is imported from, as the source of ``module`` says."""
    imports = [node for node in ast.walk(ast.parse(inspect.getsource(module))) if isinstance(node, ast.ImportFrom)]
    package = module.__name__.split(".")
    return {
        alias.asname or alias.name: ".".join([*package[: len(package) + 1 - node.level], *filter(None, [node.module])])
        for node in imports
        if node.level
        for alias in node.names
    }


def said_of_value(module: ModuleType, name: str) -> list[str]:
    """What stands below a value where it is defined, or what it is."""
    thing = getattr(module, name)
    if isinstance(thing, Measure):
        return [f"A measure: *{thing.name}*" + (f", in {thing.unit}." if thing.unit else ", a plain number.")]
    home = homes(module).get(name, module.__name__)
    said = ModuleAnalyzer.for_module(home).find_attr_docs().get(("", name))
    return said or [f"{thing!r}, as a number in SI." if isinstance(thing, float) else f"A {type(thing).__name__}."]


def directive(module: ModuleType, name: str) -> str:
    """What Sphinx is told of one name."""
    thing, place = getattr(module, name), f"{module.__name__}.{name}"
    if inspect.ismodule(thing):
        return f".. automodule:: {thing.__name__}\n   :members:\n"
    if inspect.isclass(thing):
        return f".. autoclass:: {place}\n   :members:\n"
    if callable(thing) and not isinstance(thing, Measure):
        return f".. autofunction:: {place}\n"
    said = "\n".join(f"   {line}".rstrip() for line in said_of_value(module, name))
    return f".. py:data:: {name}\n   :module: {module.__name__}\n\n{said}\n"


KINDS: dict[str, Callable[[object], bool]] = {
    "Modules": inspect.ismodule,
    "Classes": inspect.isclass,
    "Functions": lambda thing: callable(thing) and not isinstance(thing, Measure),
    "Measures": lambda thing: isinstance(thing, Measure),
    "Values": lambda thing: True,
}
"""Under which heading of a page a thing stands: the first that says so."""


def sections(module: ModuleType, names: list[str]) -> Iterator[str]:
    """The headings of a page, with what stands under each."""
    of = {name: next(kind for kind, holds in KINDS.items() if holds(getattr(module, name))) for name in names}
    for kind in KINDS:
        if here := [name for name in names if of[name] == kind]:
            yield titled(kind, "-") + "\n".join(directive(module, name) for name in here)


def titled(text: str, under: str) -> str:
    return f"{text}\n{under * len(text)}\n\n"


def wing_page(module: ModuleType) -> str:
    """The page of a wing."""
    opening = f".. automodule:: {module.__name__}\n   :no-members:\n"
    return "\n".join([titled(module.__name__, "="), opening, *sections(module, public(module))])


def first_page(documented: dict[str, str]) -> str:
    """The page of ``camkit`` itself: every name with the wing that describes it, and what no wing lists."""
    rows = [f"   * - {linked(name, documented)}\n     - {line(name)}" for name in camkit.__all__]
    others = [name for name in camkit.__all__ if name not in documented]
    opening = ".. automodule:: camkit\n   :no-members:\n"
    table = ".. list-table::\n   :header-rows: 1\n\n   * - name\n     - what it is\n" + "\n".join(rows) + "\n"
    return "\n".join([titled("camkit", "="), opening, table, *sections(camkit, others)])


def linked(name: str, documented: dict[str, str]) -> str:
    """A name as a link to where it is described."""
    return f":py:obj:`{name} <{documented.get(name, f'camkit.{name}')}>`"


def line(name: str) -> str:
    """The first sentence of what is said of a name of ``camkit``."""
    thing = getattr(camkit, name)
    if isinstance(thing, (float, dict, tuple)):
        return said_of_value(camkit, name)[0]
    return (inspect.getdoc(thing) or "").split("\n\n")[0].replace("\n", " ").replace("|", "\\|")


def write_pages(folder: Path) -> None:
    """One page for each wing and one for ``camkit``, written where Sphinx finds them."""
    modules = [import_module(f"camkit.{wing}") for wing in wings()]
    documented = {name: f"{module.__name__}.{name}" for module in modules for name in public(module)}
    pages = {module.__name__: wing_page(module) for module in modules} | {"camkit": first_page(documented)}
    for name, text in pages.items():
        write(folder / f"{name}.rst", text)
    listed = "\n".join(f"   {name}" for name in sorted(pages))
    write(folder / "index.rst", f"{titled('The names, wing by wing', '=')}.. toctree::\n   :maxdepth: 1\n\n{listed}\n")
