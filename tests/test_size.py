"""How large the package's files and functions may grow, and how deep its families of classes.

A function's length is that of its code, from its name to its end, without its docstring.
"""

import ast
import importlib
import inspect
import pkgutil
from functools import cache, cached_property
from pathlib import Path
from statistics import median

import camkit

ROOT = Path(camkit.__file__).parent
FILE, FUNCTION, MEDIAN, DEPTH = 400, 40, 4, 3
"""The most lines of a file and of a function, the most of the median function, the most classes one above the other."""

LARGER = {}
"""Files that are still larger, with the lines that they have; none of them may grow."""


@cache
def trees():
    paths = sorted(ROOT.rglob("*.py"))
    return {path.relative_to(ROOT).as_posix(): ast.parse(path.read_text(encoding="utf-8")) for path in paths}


def lines(node):
    return node.end_lineno - node.lineno + 1


def length(function):
    documented = ast.get_docstring(function) is not None
    return lines(function) - (lines(function.body[0]) if documented else 0)


def lengths():
    return {
        f"{name}: {node.name} (line {node.lineno})": length(node)
        for name, tree in trees().items()
        for node in ast.walk(tree)
        if isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))
    }


@cache
def classes():
    """Every class that the package defines, private ones too."""
    modules = [importlib.import_module(info.name) for info in pkgutil.walk_packages([str(ROOT)], "camkit.")]
    found = [thing for module in modules for thing in vars(module).values() if inspect.isclass(thing)]
    return list(dict.fromkeys(thing for thing in found if own(thing)))


def own(kind):
    return kind.__module__.split(".")[0] == "camkit"


def depth(kind):
    """How many of the package's own classes stand one above the other, the class itself among them."""
    return own(kind) + max(map(depth, kind.__bases__), default=0)


def computed(kind):
    """What a class itself computes: its properties, cached or not."""
    return {name for name, member in vars(kind).items() if isinstance(member, (property, cached_property))}


def stored(kind):
    """What a class itself declares with a type, as a dataclass does its fields."""
    return {name for name, said in inspect.get_annotations(kind).items() if "ClassVar" not in str(said)}


def test_no_file_is_too_large():
    sizes = {name: len((ROOT / name).read_text(encoding="utf-8").splitlines()) for name in trees()}
    over = {name: size for name, size in sizes.items() if size > LARGER.get(name, FILE)}
    assert not over
    assert not {name for name in LARGER if sizes.get(name, 0) <= FILE}, "no exception any more: leave it out"


def test_no_function_is_too_long():
    over = {name: size for name, size in lengths().items() if size > FUNCTION}
    assert not over


def test_the_median_function_is_short():
    assert len(lengths()) > 1000
    assert median(lengths().values()) <= MEDIAN


def test_no_class_stands_too_deep():
    deep = {f"{kind.__module__}.{kind.__name__}": depth(kind) for kind in classes() if depth(kind) > DEPTH}
    assert not deep


def test_nothing_computed_is_overridden_nor_overrides_a_field():
    """Whoever reads the class above would take one for the other; what a `Protocol` asks for is no class above."""
    silent = [
        f"{kind.__module__}.{kind.__name__}.{name} of {base.__name__}"
        for kind in classes()
        for base in kind.__mro__[1:]
        if own(base) and not getattr(base, "_is_protocol", False)
        for name in sorted(computed(kind) & (computed(base) | stored(base)) | stored(kind) & computed(base))
    ]
    assert not silent
