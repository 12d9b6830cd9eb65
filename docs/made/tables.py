"""The directive ``computed``: a table, or a piece of a page, that a function of ``made`` computes.

```{computed} laws.peaks
```
"""

import re
from collections.abc import Iterable, Sequence
from importlib import import_module

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

LEFT, RIGHT = ":--", "--:"
NUMBER = re.compile(r"\**([-\d.]+|infinite|never)\**")


def cell(value: object, digits: int = 4) -> str:
    """A cell: numbers with so many digits, what is infinite as a word, all else as the Markdown that it is."""
    if not isinstance(value, float):
        return str(value)
    if abs(value) == float("inf"):
        return "infinite"
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.{digits}g}"


def table(head: Sequence[str], rows: Iterable[Sequence[object]], digits: int = 4) -> str:
    """A table as Markdown; a column of numbers alone stands to the right."""
    cells = [[cell(value, digits) for value in row] for row in rows]
    sides = [RIGHT if all(map(NUMBER.fullmatch, column)) else LEFT for column in zip(*cells, strict=True)]
    lines = [head, sides, *cells]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def best(values: Sequence[float], digits: int = 4, least: bool = True) -> list[str]:
    """Numbers as cells, the best of them in bold."""
    top = min(v for v in values if v == v) if least else max(v for v in values if v == v)
    return [f"**{cell(v, digits)}**" if v == top else cell(v, digits) for v in values]


class Computed(SphinxDirective):
    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        module, name = self.arguments[0].split(".")
        self.env.note_reread()
        return self.parse_text_to_nodes(getattr(import_module(f"made.{module}"), name)(), allow_section_headings=True)


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_directive("computed", Computed)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
