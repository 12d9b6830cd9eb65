"""What a code host and a package index are told: workflows, forms, citation, pins for every Python."""

import json
import re
import tomllib
from importlib.metadata import PackageNotFoundError, metadata
from pathlib import Path

import pytest
import yaml
from packaging.specifiers import SpecifierSet

import camkit

REPOSITORY = Path(__file__).parents[1]
PROJECT = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
PYTHONS = re.findall(r"Python :: (3\.\d+)", "\n".join(PROJECT["classifiers"]))
PINS = dict(line.split("==") for line in (REPOSITORY / "constraints.txt").read_text(encoding="utf-8").split())


def hosted(name: str) -> dict[str, object]:
    found: dict[str, object] = yaml.safe_load((REPOSITORY / name).read_text(encoding="utf-8"))
    return found


def test_every_python_that_is_named_is_checked_on_every_system() -> None:
    job = hosted(".github/workflows/ci.yml")["jobs"]["installed"]  # type: ignore[index]
    matrix = job["strategy"]["matrix"]
    assert matrix["python"] == PYTHONS
    assert f">={PYTHONS[0]}" == PROJECT["requires-python"]
    assert {each.partition("-")[0] for each in matrix["os"]} == {"ubuntu", "macos", "windows"}


def test_workflows_run_what_is_there_and_know_no_secret() -> None:
    text = (REPOSITORY / ".github/workflows/ci.yml").read_text(encoding="utf-8")
    named = re.findall(r"(?:tests|\.ci)/[\w./]+", text)
    assert len(named) > 10
    assert [name for name in named if not (REPOSITORY / name).exists()] == []
    for path in (REPOSITORY / ".github/workflows").glob("*.yml"):
        assert "secrets." not in path.read_text(encoding="utf-8")
        assert hosted(f".github/workflows/{path.name}")["permissions"] == {"contents": "read"}


def test_a_release_is_published_without_a_password_after_all_checks() -> None:
    jobs = hosted(".github/workflows/release.yml")["jobs"]
    assert jobs["checks"]["uses"] == "./.github/workflows/ci.yml"  # type: ignore[index]
    assert (jobs["build"]["needs"], jobs["publish"]["needs"]) == ("checks", "build")  # type: ignore[index]
    assert jobs["publish"]["permissions"] == {"id-token": "write"}  # type: ignore[index]


@pytest.mark.parametrize("path", sorted((REPOSITORY / ".github/ISSUE_TEMPLATE").glob("*.yml")), ids=lambda p: p.stem)
def test_a_form_asks_each_thing_once(path: Path) -> None:
    form = hosted(f".github/ISSUE_TEMPLATE/{path.name}")
    assert {"name", "description", "labels", "body"} == form.keys()
    fields = form["body"]
    assert {field["type"] for field in fields} <= {"textarea", "input", "dropdown"}  # type: ignore[attr-defined]
    ids = [field["id"] for field in fields]  # type: ignore[attr-defined]
    assert len(ids) == len({*ids})
    assert all(field["attributes"]["label"] for field in fields)  # type: ignore[attr-defined]


def test_the_citation_names_this_version() -> None:
    """Its keys are those of the Citation File Format 1.2."""
    said = hosted("CITATION.cff")
    assert {"cff-version", "message", "title", "authors"} < said.keys()
    allowed = {"abstract", "doi", "keywords", "license", "repository-code", "type", "url", "version", "date-released"}
    assert said.keys() - {"cff-version", "message", "title", "authors"} <= allowed
    assert (said["cff-version"], said["type"]) == ("1.2.0", "software")
    assert (str(said["version"]), said["license"]) == (camkit.__version__, PROJECT["license"])
    assert said["authors"] == PROJECT["authors"]


def test_what_is_updated_by_itself_is_there() -> None:
    kinds = {update["package-ecosystem"] for update in hosted(".github/dependabot.yml")["updates"]}  # type: ignore[attr-defined]
    assert kinds == {"pip", "github-actions"}


def test_hooks_and_container_use_what_make_installs() -> None:
    (local,) = hosted(".pre-commit-config.yaml")["repos"]  # type: ignore[misc]
    assert local["repo"] == "local"
    assert all(hook["language"] == "system" for hook in local["hooks"])
    container = json.loads((REPOSITORY / ".devcontainer/devcontainer.json").read_text(encoding="utf-8"))
    target = container["postCreateCommand"].removeprefix("make ")
    assert target == ".venv/.test"
    assert container["image"].rpartition(":")[2].partition("-")[0] in PYTHONS


@pytest.mark.parametrize("python", [f"{PYTHONS[0]}.0", *(f"{each}.0" for each in PYTHONS[1:])])
def test_every_pin_allows_every_python(python: str) -> None:
    """As far as it is installed here; the first release of each, which a long-lived system may have."""
    refused, seen = {}, 0
    for name, pinned in PINS.items():
        try:
            found = metadata(name)
        except PackageNotFoundError:
            continue
        if found["Version"] == pinned:
            seen += 1
            wanted = found.get("Requires-Python") or ""
            if python not in SpecifierSet(wanted):
                refused[name] = wanted
    assert seen > 100
    assert refused == {}
