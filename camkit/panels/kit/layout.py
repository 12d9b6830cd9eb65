"""How widgets stand beside each other, and a button that does one thing."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import ipywidgets as w


def button(
    description: str, act: Callable[[], object], icon: str = "", width: str | None = "auto", **look: object
) -> w.Button:
    """A button; pressing it calls ``act()``."""
    made = w.Button(description=description, icon=icon, layout=w.Layout(width=width), **look)
    made.on_click(lambda _: act())
    return made


def menu(
    options: object, description: str, width: str, description_width: str = "initial", **look: object
) -> w.Dropdown:
    """A menu with its name before it."""
    style = {"description_width": description_width}
    return w.Dropdown(options=options, description=description, layout=w.Layout(width=width), style=style, **look)


def wrapped(*children: w.Widget) -> w.HBox:
    """A row that goes on in the next line where the page is narrow."""
    return w.HBox(children, layout=w.Layout(flex_flow="row wrap"))


def column(children: Sequence[w.Widget], usual: int, largest: int | None = None) -> w.VBox:
    """Widgets below each other, with a usual and a largest width (px)."""
    return w.VBox(children, layout=w.Layout(flex=f"1 1 {usual}px", max_width=largest and f"{largest}px"))
