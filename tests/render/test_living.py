"""What cannot become a page is refused in one sentence that says why."""

import pytest

from camkit import TranslatingRollerCam, explore, picture
from camkit.render import to_html


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
