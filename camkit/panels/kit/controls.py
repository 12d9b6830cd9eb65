"""Controls made from declarations: a row for each quantity, with a slider to drag and a box to type in."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from pathlib import Path

import anywidget
import ipywidgets as w
import traitlets

from ...files.json_file import MOST_BYTES
from ...quantities import Choice, Quantity, label
from ...quantities.markup import Html, attribute, escaped, html, joined
from ...units import in_unit
from .number import NumberBox, staying
from .quiet import Quiet

GREEK = ["alpha", "beta", "gamma", "delta", "epsilon", "theta", "lambda", "rho", "sigma", "tau", "phi", "psi", "omega"]
"""Letters that HTML names as symbols do."""
LABEL = "0 0 13.2em"
"""Room for a quantity's symbol and name, in the page's own letters."""


def symbol_html(symbol: str) -> Html:
    """``psi_0`` as a reader expects it."""
    letter, _, index = symbol.partition("_")
    letter = Html(f"&{letter};") if letter in GREEK else letter
    return html("<i>{}</i><sub>{}</sub>", letter, index) if index else html("<i>{}</i>", letter)


def label_html(name: str, declared: Quantity | Choice) -> Html:
    """A quantity's symbol and name (once, where they are the same); its meaning to hover, and how it is said aloud."""
    said = label(name, declared)
    shown = escaped(said)
    if isinstance(declared, Quantity):
        symbol = symbol_html(declared.symbol)
        shown = html("{}&ensp;{}", symbol, said) if said != declared.symbol else symbol
        said = f"{said}, {declared.unit}" if declared.unit else said
    return html("<span {} {}>{}</span>", attribute("title", declared.meaning), attribute("data-name", said), shown)


def small_html(text: object) -> Html:
    """A unit or a hint, paler than the rest."""
    return html("<span class='camkit-unit'>{}</span>", text)


def bar_html(colour: str, width: int, text: object) -> Html:
    """A bar in a colour, and a text behind it."""
    style = attribute("style", f"width: {width}px; background: {colour}")
    return html("<span class='camkit-bar' {}></span>{}", style, text)


def tables_html(*tables: Html) -> Html:
    """Tables beside each other in the panels' style."""
    return html("<div class='camkit-tables'>{}</div>", joined(tables))


class NumberRow:
    """One number: symbol, name, slider, box, unit.

    The slider moves in steps; a number typed into the box counts to its last digit, even outside the slider's range.
    ``value`` is in SI, exact; the box shows six digits of it.  ``changed()`` is called for another number,
    ``refused(sentence)`` for what is no number or far too large; the last number then stays.
    """

    def __init__(
        self,
        name: str,
        declared: Quantity,
        value: float,
        changed: Callable[[], None],
        refused: Callable[[str], None],
    ) -> None:
        self.declared, self.value, self._changed, self._quiet = declared, float(value), changed, Quiet()
        self._refused = staying(label(name, declared), refused)
        shown, step = in_unit(self.value, declared.unit), 10 ** _decade((declared.high - declared.low) / 500)
        self.slider = w.FloatSlider(
            value=shown,
            min=min(declared.low, shown),
            max=max(declared.high, shown),
            step=step,
            readout=False,
            tooltip=declared.meaning,
            layout=w.Layout(width="auto", min_width="60px", flex="1 1 80px"),
        )
        self.slider.value = on_grid(self.slider, shown)
        self.box = NumberBox(
            _six_digits(shown),
            self._refused,
            declared.unit,
            step=step,
            meaning=declared.meaning,
            layout=w.Layout(width="5.9em"),
        )
        caption = w.HTML(label_html(name, declared), layout=w.Layout(flex=LABEL))
        unit = w.HTML(small_html(declared.unit), layout=w.Layout(flex="0 0 4.2em"))
        self.row = w.HBox([caption, self.slider, self.box, unit], layout=w.Layout(align_items="center"))
        self.row.add_class("camkit-knob")
        self._quiet.hear(self.slider, self._moved)
        self._quiet.hear(self.box, self._typed)

    def set(self, value: float) -> None:
        """Show ``value`` (SI) without telling anyone."""
        self.value = float(value)
        shown = in_unit(self.value, self.declared.unit)
        self._put(self.box, _six_digits(shown))
        self._put(self.slider, shown)

    def _put(self, widget: w.Widget, shown: float) -> None:
        with self._quiet:
            widget.value = on_grid(widget, shown) if widget is self.slider else shown

    def _moved(self, shown: float) -> None:
        """The slider moved; that the page snaps a typed value to the slider's steps is no move."""
        if abs(shown - self.value / self.declared.factor) > 0.501 * self.slider.step:
            self.value = float(f"{shown:.10g}") * self.declared.factor
            self._put(self.box, _six_digits(shown))
            self._changed()

    def _typed(self, shown: float) -> None:
        value = float(shown * self.declared.factor)
        if math.isfinite(shown) and math.isinf(value):  # beyond all numbers in SI: the largest there is
            value = math.copysign(sys.float_info.max, shown)
        if far_too_large(self.declared, value):
            self.set(self.value)
            typed = f"{shown:.6g} {self.declared.unit}".rstrip()
            self._refused(f"{typed} was typed; it must be {self.declared.possible_for(value)}")
            return
        self.value = value
        self._put(self.slider, shown)
        self._changed()


def far_too_large(declared: Quantity, value: float) -> bool:
    """Whether a finite ``value`` (SI) cannot be and is also larger than all that its slider offers."""
    largest = max(abs(declared.low), abs(declared.high)) * declared.factor
    return math.isfinite(value) and abs(value) > largest and not declared.allows(value)


def on_grid(slider: w.FloatSlider, shown: float) -> float:
    """The step of ``slider`` next to ``shown``, to the last bit as the page reckons it (noUiSlider, in per cent).

    The page sends back what it has to correct; while the kernel is busy that comes late, and would undo what was shown
    in the meantime.
    """
    if not math.isfinite(shown):
        return float(slider.value)
    low, width = slider.min, slider.max - slider.min or 1.0
    each = 100 * slider.step / width
    percent = math.floor(100 * (max(shown, low) - low) / width / each + 0.5) * each
    return float(percent * width / 100 + low) if shown < slider.max and percent < 100 else slider.max


def _six_digits(shown: float) -> float:
    return float(f"{shown:.6g}")


def _decade(width: float) -> int:
    """The power of ten at or below ``width``."""
    return int(f"{width:e}".split("e")[1])


class Download(anywidget.AnyWidget):
    """A button; pressing it downloads what ``content()`` returns at that moment as ``filename``.

    ``refused(sentence)`` is called where there is nothing to be had, with the reason.
    """

    _esm = Path(__file__).with_name("download.js").read_text(encoding="utf-8")
    description = traitlets.Unicode("").tag(sync=True)

    def __init__(
        self,
        description: str,
        filename: str,
        mime: str,
        content: Callable[[], str],
        refused: Callable[[str], None] | None = None,
    ) -> None:
        super().__init__(description=description)
        self.filename, self.mime, self.content, self.refused = filename, mime, content, refused
        self.on_msg(lambda *_: self._pressed())

    def _pressed(self) -> None:
        try:
            text = self.content()
        except ValueError as refusal:
            if self.refused is None:
                raise
            self.refused(f"Nothing is saved: {refusal}.")
        else:
            self.send({"name": self.filename, "mime": self.mime, "text": text})


class Upload(anywidget.AnyWidget):
    """A button; ``use(data)`` is called with the bytes of the file that a person chooses."""

    _esm = Path(__file__).with_name("upload.js").read_text(encoding="utf-8")
    description = traitlets.Unicode("").tag(sync=True)
    accept = traitlets.Unicode(".json").tag(sync=True)
    most = traitlets.Int(MOST_BYTES + 1).tag(sync=True)

    def __init__(self, description: str, use: Callable[[bytes], None]) -> None:
        super().__init__(description=description)
        self.on_msg(lambda _, __, buffers: use(bytes(buffers[0])))
