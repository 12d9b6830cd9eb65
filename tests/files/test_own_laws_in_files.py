"""Laws that are functions of one's own, in files: found by module and name, and never a reason to import or to run."""

import json
import sys

import numpy as np
import pytest

from camkit import Cycloidal, Study, TranslatingRollerCam, deg
from camkit.files import Session, from_json, to_json
from camkit.motion import ModifiedSine, UserLaw
from camkit.quantities import value_of, with_quantities

PATH = "motion.rise.law"
MODULE = """
import numpy as np
from camkit.motion import Cycloidal, ModifiedSine, UserLaw

ran = []

def gentle(u):
    return Cycloidal()(u)

@UserLaw
def declared(share):
    return ModifiedSine()(share)

def destroy(files):
    ran.append(files)
    return ModifiedSine()(files)

def two(u, lift):
    return Cycloidal()(u)

def scaled(u, by=1.0):
    return Cycloidal()(u)
"""


def gentle(u):
    """A law at the top of this module."""
    return Cycloidal()(u)


def cam(law):
    return with_quantities(TranslatingRollerCam(), {PATH: law})


@pytest.fixture
def laws(tmp_path, monkeypatch):
    """A module of a user's own, which is imported."""
    (tmp_path / "laws_of_mine.py").write_text(MODULE)
    monkeypatch.syspath_prepend(tmp_path)
    yield __import__("laws_of_mine")
    sys.modules.pop("laws_of_mine", None)


def test_a_law_comes_back_with_its_name_and_function(laws):
    for law in (gentle, UserLaw(gentle, "my gentle law"), UserLaw(laws.gentle), laws.declared, UserLaw(laws.scaled)):
        again = from_json(to_json(cam(law)))
        assert again == cam(law)
        assert value_of(again, PATH).function is value_of(cam(law), PATH).function
    named = from_json(to_json(cam(UserLaw(gentle, "my gentle law"))))
    assert value_of(named, PATH).name == "my gentle law"


def test_a_session_that_frees_it_comes_back(laws):
    menu = {PATH: (ModifiedSine(), UserLaw(laws.gentle), laws.declared), "motion.rise.angle": (80 * deg, 130 * deg)}
    study = Study(cam(gentle), menu, TranslatingRollerCam.measures[:2])
    again = from_json(to_json(Session(study, study.start)), Session)
    assert again.study.menus[0].names == ("modified sine", "gentle", "declared")
    assert (again.design, dict(again.study.free)) == (study.start, dict(study.free))


def test_a_module_that_is_not_imported_is_asked_for_and_not_imported(laws):
    text = to_json(cam(UserLaw(laws.gentle)))
    del sys.modules["laws_of_mine"]
    told = (
        r"'gentle' of the module 'laws_of_mine', which is not imported here: import laws_of_mine, then read it again$"
    )
    with pytest.raises(ValueError, match=told):
        from_json(text)
    assert "laws_of_mine" not in sys.modules
    __import__("laws_of_mine")
    np.testing.assert_array_equal(from_json(text).motion(1.0), cam(Cycloidal()).motion(1.0))


def test_a_function_of_a_notebook_is_looked_for_among_its_cells(monkeypatch):
    main = sys.modules["__main__"]
    exec(
        "from camkit import Cycloidal\ndef of_a_cell(u):\n    return Cycloidal()(u)", space := {"__name__": "__main__"}
    )
    monkeypatch.setattr(main, "of_a_cell", space["of_a_cell"], raising=False)
    text = to_json(cam(space["of_a_cell"]))
    assert value_of(from_json(text), PATH).function is space["of_a_cell"]
    monkeypatch.delattr(main, "of_a_cell")
    with pytest.raises(
        ValueError, match=r"of this notebook, this notebook has none: run the cell that defines it, then"
    ):
        from_json(text)


@pytest.mark.parametrize(
    "place",
    [
        "os:system",
        "os:abort",
        "shutil:rmtree",
        "builtins:print",
        "builtins:exec",
        "laws_of_mine:destroy",
        "laws_of_mine:two",
        "laws_of_mine:np",
        "laws_of_mine:Cycloidal",
        "laws_of_mine:__builtins__",
        "laws_of_mine:missing",
        "laws_of_mine:gentle.__globals__",
        "numpy:sin",
        "antigravity:geohash",
        "camkit.files.functions:function_at",
        "",
        ":",
        "gentle",
        7,
        None,
        ["os", "system"],
        {"kind": "UserLaw"},
    ],
    ids=str,
)
def test_a_file_can_name_nothing_but_a_law(laws, place):
    entry = json.loads(to_json(cam(UserLaw(laws.gentle))))
    law = entry["design"]["motion"]["segments"][0]["law"]
    assert law["function"] == "laws_of_mine:gentle"
    law["function"], before = place, {*sys.modules}
    with pytest.raises(ValueError, match="function"):
        from_json(json.dumps(entry))
    assert {*sys.modules} == before
    assert laws.ran == []


def test_what_would_not_be_found_again_is_not_saved(laws, monkeypatch):
    def within(u):
        return Cycloidal()(u)

    for law in (lambda u: Cycloidal()(u), within, Cycloidal().at):
        with pytest.raises(ValueError, match=r"is a function of one's own without a name in its module, which no file"):
            to_json(cam(law))
    changed = cam(UserLaw(laws.gentle))
    monkeypatch.setattr(laws, "gentle", laws.declared)
    with pytest.raises(
        ValueError, match=r"is the function gentle, which no file can hold: the module 'laws_of_mine' has"
    ):
        to_json(changed)
    with pytest.raises(ValueError, match=r"or its argument is not u$"):
        to_json(cam(UserLaw(laws.destroy)))
    assert laws.ran  # it was given as a law, and so asked
