"""What a person does on the page of an instrument, as the page tells the kernel of it."""

from __future__ import annotations

from camkit.quantities import choices_of, declared_in, quantities_of
from camkit.units import in_unit


def move(app, path, shown):
    """Let go of a slider, or type a number, in the quantity's unit."""
    at = list(quantities_of(app.design)).index(path)
    values = list(app.values)
    values[at] = shown * quantities_of(app.design)[path].factor
    app.values = values


def choose(app, path, option):
    """Take another option from a menu, by its name or as it is."""
    ask(app, choose=[path, option if isinstance(option, str) else choices_of(app.design)[path].text(option)])


def at(app, path):
    """Where the page's slider stands, in the quantity's unit."""
    declared = quantities_of(app.design)[path]
    return in_unit(app.values[list(quantities_of(app.design)).index(path)], declared.unit)


def sliders(app):
    """The paths that have a slider or a menu on the page."""
    choices = {choice["path"] for choice in app.structure["choices"]}
    free = [quantity["free"] for quantity in app.structure["quantities"]]
    numbers = dict(zip(quantities_of(app.design), free, strict=True))
    return [path for path in declared_in(app.design) if path in choices or numbers.get(path)]


def ask(app, buffers=(), **message):
    """What else the page sends."""
    app._handle_custom_msg(message, [memoryview(data) for data in buffers])


def open_file(app, file, name="file"):
    """Drop a file on the page, or choose one."""
    ask(app, [file if isinstance(file, bytes) else file.encode()], open=name)


def answers(app, **message):
    """What the page is sent when it asks: contents and buffers."""
    sent = []
    app.send = lambda content, buffers=(): sent.append((content, list(buffers)))
    try:
        ask(app, **message)
    finally:
        del app.send
    return sent


def file_of(app, kind):
    """What the page gets to save, as bytes; nothing if it gets none."""
    sent = answers(app, file=kind)
    return sent[0][1][0] if sent else b""
