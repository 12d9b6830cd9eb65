"""The site as `make docs` makes it, without a warning: no network, no dead link, nothing missing."""

import importlib
import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from filelock import FileLock
from PIL import Image
from sphinx.errors import ExtensionError

import camkit
from camkit.motion import ModifiedTrapezoid

REPOSITORY = Path(__file__).parents[3]
sys.path.insert(0, str(REPOSITORY / "docs"))

from made import rules  # noqa: E402
from made.api import public, wings  # noqa: E402
from made.checked import faults  # noqa: E402
from made.formulas import mathml  # noqa: E402
from made.held import functions  # noqa: E402
from made.notebooks import page  # noqa: E402

NOTEBOOKS = sorted((REPOSITORY / "notebooks").rglob("*.ipynb"))


@pytest.fixture(scope="session")
def site(tmp_path_factory) -> Path:
    """The folder of the finished site, made once for both processes."""
    folder = tmp_path_factory.getbasetemp().parent
    with FileLock(folder / "site.lock"):
        if not (folder / "site" / "index.html").exists():
            options = ["-q", "-W", "--keep-going", "-j", "2"]
            command = [sys.executable, "-m", "sphinx", *options, "docs", str(folder / "site")]
            made = subprocess.run(command, cwd=REPOSITORY, capture_output=True, text=True)
            if made.returncode:
                shutil.rmtree(folder / "site", ignore_errors=True)
            assert not made.returncode, made.stderr[-4000:]
    return folder / "site"


def read(page: Path) -> str:
    return page.read_text(encoding="utf-8")


def test_every_page_is_whole(site):
    assert not faults(site)
    assert len([*site.rglob("*.html")]) > len(NOTEBOOKS) + len(wings())


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("<a href='gone.html'>x</a>", "leads to no file"),
        ("<a href='#gone'>x</a>", "leads to no place in its page"),
        ("<script src='https://a.b/c.js'></script>", "loads https://a.b/c.js"),
        ("<link rel='stylesheet' href='//a.b/c.css'>", "loads //a.b/c.css"),
        ("<img src='page.html' alt=''>", "has no words in its place"),
        ("<iframe src='page.html'></iframe>", "has no title"),
        ("<h1>a</h1><h3>b</h3>", "a heading of level 3 stands below one of level 1"),
    ],
)
def test_what_is_wrong_with_a_page_is_found(tmp_path, text, fault):
    page = f"<html lang='en'><title>a page</title>{text}"
    (tmp_path / "page.html").write_text(page, encoding="utf-8")
    assert [found for found in faults(tmp_path) if fault in found]


def test_a_page_without_fault_has_none(tmp_path):
    page = (
        "<html lang='en'><title>a page</title><h1 id='top'>a</h1><a href='#top'>up</a> <a href='https://a.b'>away</a>"
    )
    (tmp_path / "page.html").write_text(page, encoding="utf-8")
    assert not faults(tmp_path)


def test_every_public_name_is_described(site):
    first = read(site / "api" / "camkit.html")
    assert not [name for name in camkit.__all__ if not re.search(rf'href="[^"]*[.]{name}" title=', first)]
    for wing in wings():
        module = importlib.import_module(f"camkit.{wing}")
        page = read(site / "api" / f"camkit.{wing}.html")
        named = (f'id="camkit.{wing}.{name}"' for name in public(module))
        modules = (f'id="module-camkit.{wing}.{name}"' for name in public(module))
        assert not [one for one, two in zip(named, modules, strict=True) if one not in page and two not in page]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_has_its_pictures(site, path):
    stored = [
        output["data"]
        for cell in json.loads(read(path))["cells"]
        for output in cell.get("outputs", [])
        if "image/png" in output.get("data", {})
    ]
    shown_on = site / "notebooks" / path.relative_to(REPOSITORY / "notebooks").with_suffix(".html")
    shown = re.findall(r'<img[^>]* alt="[^"]{8,}"', read(shown_on))
    assert len(shown) >= max(len(stored), 1)
    assert "jupyter-widget" not in read(shown_on)


def test_formulas_need_no_script(site):
    pages = [read(page) for page in (site / "theory").glob("*.html")]
    assert sum(page.count("<math") for page in pages) > 100
    assert not [
        page for page in pages if re.search(r"<script[^>]*(mathjax|katex)|window\.MathJax", page, re.IGNORECASE)
    ]


def test_a_formula_that_cannot_be_read_stops_the_build():
    with pytest.raises(ExtensionError, match=r"the formula '.*frac' cannot be read"):
        mathml(r"\frac", display=True)


def test_every_formula_page_names_tests_that_are_there():
    texts = [read(path) for path in (REPOSITORY / "docs" / "theory").glob("*.md")]
    named = [one for text in texts for one in re.findall(r"\{held\} (\S+)::(\S+)", text)]
    assert len(named) > 40
    assert not [(path, name) for path, name in named if name not in functions(REPOSITORY / path)]


def test_the_table_of_laws_is_what_the_laws_say(site):
    page = re.sub(r"<[^>]+>", " ", read(site / "choose" / "law.html"))
    cells = re.search(r"modified trapezoid\s+([\d.]+)\s+([\d.]+)\s+([\d.]+)", page)
    assert [float(cell) for cell in cells.groups()] == pytest.approx(list(ModifiedTrapezoid().peaks()), rel=1e-3)


def test_what_sways_no_rule_by_itself_is_told_from_what_does():
    """The identity sways no rule; a weighted sum hears weights, and a knee does not."""
    assert {name: rules.swayed(rule, lambda front, k, random: front) for name, rule in rules.RULES.items()} == (
        dict.fromkeys(rules.RULES, 0.0)
    )
    assert rules.more_weight("weighted sum") > 10
    assert rules.more_weight("knee") == 0


def test_the_picture_of_the_readme_moves():
    picture = REPOSITORY / "docs" / "_static" / "turning.png"
    assert picture.stat().st_size < 1_000_000
    assert Image.open(picture).n_frames > 30
    assert "docs/_static/turning.png" in read(REPOSITORY / "README.md")


def test_a_lesson_is_seen_as_a_learner_sees_it():
    cells = [
        {"cell_type": "markdown", "metadata": {"tags": ["instructor"]}, "source": "35 minutes"},
        {"cell_type": "markdown", "metadata": {"tags": ["solution"]}, "source": "because"},
        {"cell_type": "code", "metadata": {"tags": ["solution"]}, "source": "41", "outputs": []},
    ]
    text, code = json.loads(page({"cells": cells}))["cells"]
    assert re.fullmatch(r"<details>.*because.*</details>", text["source"], re.DOTALL)
    assert "hide-cell" in code["metadata"]["tags"]
