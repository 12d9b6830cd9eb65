"""What every page is made of: its script and style, JSON that stands in it, and how roles look."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from ..program.page import MACHINE
from .roles import ROLES, STROKES, colour, letter_colour

PAGE = Path(__file__).with_name("page")
MODULES = (
    *("numbers", "units", "marks", "scales", "axes", "heading", "picture", "spans", "controls"),
    *("positions", "pointer", "files", "kernel", "parts", "theme"),
    *(
        "sheet",
        "docks",
        "engine",
        "idle",
        "drop",
        "bar",
        "history",
        "measures",
        "around",
        "beside",
        "verdict",
        "quantities",
    ),
    *("made", "tabs", "why", "handles", "places", "pull", "names", "panel", "session", "cell"),
)
"""What every page is made of, each on those before it."""
STYLE = "\n".join((PAGE / name).read_text(encoding="utf-8") for name in ("panel.css", "sheet.css"))
"""How pages look."""
DASHES: Mapping[str, Sequence[float]] = {"-": (), "--": (3.7, 1.6), ":": (1.0, 1.65), "-.": (6.4, 1.6, 1.0, 1.6)}
"""Of a line, in its widths."""
THEMES = ("light", "dark")
"""In which a page may be."""


def look() -> object:
    """How roles look in each theme, and the strokes and dashes of lines, widths in points."""
    plain = [name for name in ROLES if name != "series"]
    return {
        "roles": {
            name: {"light": role.light, "dark": role.dark, "width": role.width, "dashes": DASHES[str(role.dashes)]}
            for name, role in ROLES.items()
        },
        "series": {theme: [colour("series", i, theme) for i in range(20)] for theme in THEMES},
        "letters": {theme: {name: letter_colour(name, 0, theme) for name in plain} for theme in THEMES},
        "seriesLetters": {theme: [letter_colour("series", i, theme) for i in range(20)] for theme in THEMES},
        "strokes": {name: _stroke(style) for name, style in STROKES.items()},
    }


def _stroke(style: Mapping[str, object]) -> object:
    width, dashes, cap = (style.get(name) for name in ("linewidth", "linestyle", "solid_capstyle"))
    return {"width": width, "dashes": dashes and DASHES[str(dashes)], "cap": cap}


def in_html(content: object) -> str:
    """JSON that stands in an element of a page: nothing in it ends the element or begins a comment.

    >>> print(in_html({"name": "</script><!--"}))
    {"name":"\\u003c/script>\\u003c!--"}
    """
    return json.dumps(content, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def script(entry: str) -> str:
    """The page's modules in one file, each in a scope of its own, those it needs before it; ``entry`` comes last.

    What runs programs is made of the table of operations, and the same for all.
    """
    machine = f"const machine = {MACHINE};"
    return "\n".join([machine, *(_scoped(name) for name in MODULES), _linked(entry)])


def _scoped(name: str) -> str:
    """A module as a constant that holds what it exports."""
    text = _linked(f"{name}.js")
    exported = re.findall(r"^export (?:async )?(?:function|class|const) (\w+)", text, re.MULTILINE)
    body = re.sub(r"^export ", "", text, flags=re.MULTILINE)
    return f"const {name} = (() => {{\n{body}return {{ {', '.join(exported)} }};\n}})();"


def _linked(file: str) -> str:
    """The text of a module, what it imports taken from the constants before it."""
    text = (PAGE / file).read_text(encoding="utf-8")
    return re.sub(r'^import (\{.*\}) from "\./(\w+)\.js";', r"const \1 = \2;", text, flags=re.MULTILINE)
