"""What a person sees and does on a sheet, as the page tells the kernel of it."""

from __future__ import annotations

from camkit.panels.kit.inputs import Download, Upload
from camkit.panels.kit.parts import Button


def parts(sheet, kind):
    """All parts of a kind."""
    return [part for part in sheet.top.inside() if isinstance(part, kind)]


def press(sheet, words):
    """Press a button."""
    next(button for button in parts(sheet, Button) if button.description == words).click()


def do(sheet, part, **done):
    """What the page says of a part, as it says it."""
    buffers = done.pop("buffers", [])
    sheet._handle_custom_msg({"part": part.number, "count": sheet.body["heard"] + 1, **done}, buffers)


def alert(sheet):
    """The sentence in the banner, empty if none is shown."""
    return sheet.banner.text if sheet.banner.visible else ""


def downloaded(sheet, words):
    """The file that a button gives to the page; nothing if it gives none."""
    button = next(part for part in parts(sheet, Download) if part.description == words)
    sent = []
    button.send = sent.append
    do(sheet, button)
    return sent[0] if sent else {}


def upload(sheet, words, file):
    """As the page does it when a person has chosen a file."""
    button = next(part for part in parts(sheet, Upload) if part.description == words)
    do(sheet, button, buffers=[memoryview(file if isinstance(file, bytes) else file.encode())])


def click(sheet, x, y):
    """A click in the picture, at a place in its user units."""
    do(sheet, sheet.picture, does="click", view=0, at=[x, y], pixel=[1e-9, 1e-9])
