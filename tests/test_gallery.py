"""The gallery: every notebook has a card with a picture, in notebook 00 and on the first page of `make app` alike."""

import re
from pathlib import Path

import nbformat
import pytest

REPOSITORY = Path(__file__).parents[1]
NOTEBOOKS = sorted((REPOSITORY / "notebooks").glob("*.ipynb"))[1:]
GALLERY = nbformat.read(REPOSITORY / "notebooks" / "00_start_here.ipynb", as_version=4)
PAGE = (REPOSITORY / ".jupyter/voila/templates/camkit/tree-lab.html").read_text(encoding="utf-8")
CARDS = {name: card for name, *card in re.findall(r'"(\d\d_\w+\.ipynb)": \("([^"]+)", "([^"]+)"\)', PAGE)}


def test_every_notebook_has_a_card():
    assert list(CARDS) == [path.name for path in NOTEBOOKS]
    assert all(cell.cell_type == "markdown" for cell in GALLERY.cells)  # nothing to run, and nothing to wait for


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_card_is_a_picture_a_line_and_a_link(path):
    name, line = CARDS[path.name]
    picture = f"images/cards/{path.stem}.png"
    table = GALLERY.cells[1].source
    assert f'[<img src="{picture}" alt="{name}" width="250">]({path.name})' in table
    assert f"**[{path.name[:2]} {name}]({path.name})**<br>{line}" in table
    assert (REPOSITORY / "notebooks" / picture).read_bytes().startswith(b"\x89PNG")
    assert (REPOSITORY / "notebooks" / picture).stat().st_size < 40_000
    assert len(line) < 120


def test_the_course_is_found_from_both():
    assert "](course/01_motion_laws.ipynb)" in GALLERY.cells[0].source
    assert 'content.type == "directory" and content.name == "course"' in PAGE
    assert "](notebooks/course)" in (REPOSITORY / "README.md").read_text(encoding="utf-8")
