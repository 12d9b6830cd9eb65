"""The directive ``held``: the test that holds a formula, opened by a click, as it stands in the repository.

    ```{held} tests/test_contact.py::test_published_contacts
    ```

A test that is no longer there stops the build.
"""

import ast
from functools import cache
from html import escape
from pathlib import Path

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

REPOSITORY = Path(__file__).parents[2]


@cache
def functions(path: Path) -> dict[str, str]:
    """The functions of a file by name, each with its decorators, as they are written."""
    text = path.read_text(encoding="utf-8")
    lines = text.splitlines()
    return {
        node.name: "\n".join(lines[min([node.lineno, *(d.lineno for d in node.decorator_list)]) - 1 : node.end_lineno])
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.FunctionDef)
    }


class Held(SphinxDirective):
    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        place, _, name = self.arguments[0].partition("::")
        path = REPOSITORY / place
        if not path.is_file() or name not in functions(path):
            raise self.error(f"there is no test {self.arguments[0]}")
        self.env.note_dependency(str(path))
        said = escape(name.removeprefix("test_").replace("_", " "))
        opened = f'<details class="held"><summary>Held by a test: {said}</summary><p><code>{escape(place)}</code></p>'
        source = nodes.literal_block(functions(path)[name], functions(path)[name], language="python")
        return [nodes.raw("", opened, format="html"), source, nodes.raw("", "</details>", format="html")]


def setup(app: Sphinx) -> dict[str, bool]:
    app.add_directive("held", Held)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
