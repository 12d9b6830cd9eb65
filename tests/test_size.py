"""How large the package's files and functions may grow, and how deep its families of classes.

A function's length is that of its code, from its name to its end, without its docstring.
"""

import ast
import importlib
import inspect
import pkgutil
import textwrap
from functools import cache, cached_property
from pathlib import Path
from statistics import median

import camkit

ROOT = Path(camkit.__file__).parent
FILE, FUNCTION, MEDIAN, STEPS = 400, 40, 4, 3
"""The most lines of a file and of a function, the most of the median function, the most steps up to a class's last
base of the package."""

DEFAULTS = {
    "CamAnalysis": {"bodies", "closing_rate", "offers", "preload", "program", "speed", "stretch"},
    "FlatAnalysis": {"pitch"},
    "Kinked": {"kinks", "kinks_move"},
    "MotionProgram": {"waves"},
    "RockingAnalysis": {"arm_force", "inertia", "resisting_torque", "static_resistance"},
    "RollerAnalysis": {"path"},
    "Segment": {"reach"},
    "SlidingAnalysis": {"start_height"},
    "Study": {"nominal"},
}
"""What a base computes as most of its kinds have it, and some of them in their own way, by name on purpose."""


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


def steps(kind):
    """How many of the package's own classes stand one above the other over a class."""
    return max((1 + steps(base) for base in kind.__bases__ if own(base)), default=0)


def computed(kind):
    """What a class itself computes: its properties, cached or not."""
    return {name for name, member in vars(kind).items() if isinstance(member, (property, cached_property))}


def stored(kind):
    """What a class itself declares with a type, as a dataclass does its fields."""
    return {name for name, said in inspect.get_annotations(kind).items() if "ClassVar" not in str(said)}


def test_no_file_is_too_large():
    sizes = {name: len((ROOT / name).read_text(encoding="utf-8").splitlines()) for name in trees()}
    over = {name: size for name, size in sizes.items() if size > FILE}
    assert not over


def test_no_function_is_too_long():
    over = {name: size for name, size in lengths().items() if size > FUNCTION}
    assert not over


def test_the_median_function_is_short():
    assert len(lengths()) > 1000
    assert median(lengths().values()) <= MEDIAN


def test_no_class_stands_too_deep():
    deep = {kind.__name__: steps(kind) for kind in classes() if steps(kind) > STEPS}
    assert not deep


def left_open(member):
    """Whether a property only says that there is one."""
    code = getattr(member, "fget", None) or getattr(member, "func", None)
    tree = ast.parse(textwrap.dedent(inspect.getsource(code))).body[0]
    body = tree.body[ast.get_docstring(tree) is not None :]
    return not body or (isinstance(body[0], ast.Raise) and "NotImplementedError" in ast.unparse(body[0]))


def overridden(kind, base):
    """What ``base`` computes and ``kind`` computes in another way or stores, or the other way round."""
    both = computed(kind) & computed(base)
    mixed = computed(kind) & stored(base) | stored(kind) & computed(base)
    return {name for name in both | mixed if not (name in computed(base) and left_open(vars(base)[name]))}


def test_nothing_computed_is_overridden_silently():
    """Whoever reads the class above would take one for the other; what a `Protocol` asks for is no class above."""
    found = {
        f"{base.__name__}.{name} by {kind.__name__}"
        for kind in classes()
        for base in kind.__mro__[1:]
        if own(base) and not getattr(base, "_is_protocol", False)
        for name in overridden(kind, base) - DEFAULTS.get(base.__name__, set())
    }
    assert not found
