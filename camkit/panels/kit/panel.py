"""What every panel shares: style, names for screen readers, a still picture with numbers where there is no kernel."""

from __future__ import annotations

import base64
from collections.abc import Callable, Sequence
from pathlib import Path

import anywidget
import ipywidgets as w

from ...quantities.applied import raised
from .banner import Banner
from .picture import LivePicture

IMPOSSIBLE = (ValueError, ArithmeticError)
"""What a design can raise that cannot be built, computed or drawn: a panel says it in a sentence."""


def reason(error: Exception) -> str:
    """Why something is impossible, in words.

    >>> reason(ValueError("the arm is too short")), reason(OverflowError(34, "Numerical result out of range"))
    ('the arm is too short', 'a number in it becomes too large')
    >>> reason(MemoryError())
    'MemoryError'
    """
    if isinstance(error, ValueError) or (len(error.args) == 1 and " " in str(error)):
        return str(error)
    return "a number in it becomes too large" if isinstance(error, ArithmeticError) else raised(error)


class PanelStyle(anywidget.AnyWidget):
    """Nothing to see: the style sheet of the panel that it is put into, and a name for each of its controls."""

    _esm = Path(__file__).with_name("panel.js").read_text(encoding="utf-8")
    _css = Path(__file__).with_name("panel.css").read_text(encoding="utf-8")


class Panel(w.VBox):
    """A column of widgets around one live ``picture``; a subclass says in ``summary`` what it shows.

    Its ``banner`` says what is impossible, its ``numbers`` say what the picture shows, where there are any.
    """

    picture: LivePicture
    banner: Banner
    numbers: w.HTML

    def __init__(self, children: Sequence[w.Widget]) -> None:
        self._followers: list[Callable[..., object]] = []
        super().__init__([PanelStyle(layout=w.Layout(display="none")), *children])
        self.add_class("camkit-panel")
        self.picture.said = self.summary

    def on_change(self, act: Callable[..., object]) -> None:
        """Call ``act`` after every change of what is shown: with the new design or program, if that is what it is."""
        self._followers.append(act)

    def _tell_followers(self, *given: object) -> None:
        """Each of them, whatever the others make of it; what one cannot do the banner says."""
        for act in self._followers:
            try:
                act(*given)
            except IMPOSSIBLE as error:
                self.banner.show_message(f"What follows this panel cannot be shown everywhere: {reason(error)}.")
            except Exception as error:  # somebody's own function: what this panel shows stays whole
                self.banner.show_message(f"What follows this panel cannot be computed: {raised(error)}.")

    def refuse_picture(self, sentence: str) -> None:
        """Show a sentence in place of the picture and the numbers, which would belong to something else.

        An empty sentence brings them back.
        """
        self.banner.show_message(sentence)
        for part in (self.picture.widget, self.numbers):
            part.layout.display = "none" if sentence else ""

    def summary(self) -> str:
        """The panel's numbers, a line each."""
        raise NotImplementedError

    def still(self) -> bytes:
        """The picture, as a PNG file, that stands for the panel where there is no kernel."""
        return self.picture.png()

    def settle(self) -> None:
        """Wait until everything that is shown belongs to what was asked for last."""

    def _repr_mimebundle_(self, **kwargs: object) -> dict[str, object]:
        """The live panel for a kernel, the picture and the numbers where there is none."""
        self.settle()
        bundle = super()._repr_mimebundle_(**kwargs)
        data = dict(bundle[0] if isinstance(bundle, tuple) else bundle or {})
        data["image/png"] = base64.b64encode(self.still()).decode("ascii")
        data["text/plain"] = self.summary()
        self.picture.describe()
        return data
