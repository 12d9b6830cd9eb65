"""The notebooks as pages of the site: as they are stored, folded as in JupyterLab, their pictures named."""

import ast
import json
import re
from pathlib import Path
from shutil import copytree, ignore_patterns

SOLUTION, INSTRUCTOR, FOLDED = "solution", "instructor", "hide-input"


def anchor(title: str) -> str:
    """How a link within a notebook names a heading, which is JupyterLab's way."""
    return title.replace(" ", "-")


def copy(source: Path, target: Path) -> None:
    """The notebooks of ``source`` with their pictures, as they change; a page that is no longer there goes."""
    copytree(source / "images", target / "images", dirs_exist_ok=True, ignore=ignore_patterns(".*"))
    found = {path.relative_to(source): path for path in [*source.glob("*.ipynb"), *source.glob("course/*.ipynb")]}
    for old in target.rglob("*.ipynb"):
        if old.relative_to(target) not in found:
            old.unlink()
    for place, path in found.items():
        write(target / place, page(json.loads(path.read_text(encoding="utf-8"))))


def write(path: Path, text: str) -> None:
    """``text`` as a file; one that has it already stays as old as it is, so that Sphinx need not read it again."""
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_text(encoding="utf-8") != text:
        path.write_text(text, encoding="utf-8")


def page(notebook: dict) -> str:
    """A notebook as learners see it, whose cells say to Sphinx what to fold, and what their pictures show."""
    heading = ""
    notebook["cells"] = [cell for cell in notebook["cells"] if INSTRUCTOR not in cell["metadata"].get("tags", ())]
    for cell in notebook["cells"]:
        source = "".join(cell["source"])
        if cell["cell_type"] == "markdown":
            if SOLUTION in cell["metadata"].get("tags", ()):
                cell["source"] = f"<details><summary>Solution</summary>\n\n{source}\n\n</details>"
            heading = ([heading, *re.findall(r"^#+ (.*)", source, re.M)])[-1]
            continue
        tags = cell["metadata"].setdefault("tags", [])
        if SOLUTION in tags:
            tags.append("hide-cell")
        elif cell["metadata"].get("jupyter", {}).get("source_hidden"):
            tags.append(FOLDED)
        cell["metadata"]["mystnb"] = {"image": {"alt": shown(cell, heading)}}
    return json.dumps(notebook, ensure_ascii=False, indent=1)


def shown(cell: dict, heading: str) -> str:
    """What the picture of a cell shows, in words: the numbers of a panel, or the views that drew it."""
    outputs = [output["data"] for output in cell["outputs"] if "image/png" in output.get("data", {})]
    said = "; ".join("".join(data["text/plain"]).replace("\n", "; ") for data in outputs)
    if said.startswith("<"):
        said = ", ".join(drawn_by("".join(cell["source"])))
    return f"{heading}: {said}".rstrip(": ")[:400]


def drawn_by(source: str) -> list[str]:
    """The names that the last statement of a cell uses, as words: the views, and what they look at."""
    names = (node.id for node in ast.walk(ast.parse(source).body[-1]) if isinstance(node, ast.Name))
    return [name.replace("_", " ") for name in dict.fromkeys(names)]
