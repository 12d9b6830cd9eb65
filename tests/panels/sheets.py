"""What a person sees and does on a sheet, as the page tells the kernel of it."""

from __future__ import annotations

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
