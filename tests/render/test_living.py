"""What a page is told of a design; what cannot become one is refused in one sentence that says why."""

import pytest

from camkit import TranslatingRollerCam, ValveCam, explore, picture
from camkit.machines import CamLever
from camkit.quantities import with_quantities
from camkit.render import to_html
from camkit.render.living import living


def nothing_seen(analysis):
    """A view that forgets to return."""


@pytest.mark.parametrize("show", [lambda cam, view: to_html(cam, view, path="cam.html"), explore, picture])
def test_a_view_that_gives_no_picture_is_named(show):
    with pytest.raises(ValueError, match=r"^the view nothing seen gives None; a view gives a Picture$"):
        show(TranslatingRollerCam(), nothing_seen)


def test_a_folder_that_is_not_there_is_named(tmp_path):
    path = tmp_path / "absent" / "cam.html"
    app = explore(TranslatingRollerCam())
    for write in (app.to_html, lambda path: to_html(TranslatingRollerCam(), path=path)):
        with pytest.raises(ValueError, match=r"^there is no folder '.*absent' to write 'cam.html' into$"):
            write(path)


@pytest.mark.parametrize(
    ("design", "path", "coefficients"),
    [
        (CamLever(), "return_law.", 4),
        (with_quantities(TranslatingRollerCam(), {"motion.rise.law": "skewed"}), "motion.rise.law.", 1),
        (TranslatingRollerCam(), "motion.rise.law.", 0),
    ],
)
def test_a_page_knows_coefficients_of_laws_and_the_curve_that_they_shape(design, path, coefficients):
    structure = living(design).structure
    names = [q["symbol"] for q in structure["quantities"] if q["shapes"]]
    assert len(names) == coefficients * (2 if path == "return_law." else 1)
    curves = [(p["name"], p["still"]) for p in structure["pictures"] if any(m.get("shaped") for m in p["marks"])]
    assert curves == ([("acceleration", "")] if coefficients else [])


def test_the_acceleration_of_a_valve_is_a_curve_that_laws_would_shape():
    marks = [m for p in living(ValveCam()).structure["pictures"] for m in p["marks"] if m.get("shaped")]
    assert [mark["key"] for mark in marks] == ["acceleration"]
