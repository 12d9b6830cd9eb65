"""`Sheet`: a small instrument of controls, pictures and tables; one widget, by itself or as a tab of another."""

from __future__ import annotations

import base64
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager

import anywidget
import traitlets

from ...quantities.applied import raised
from ...render.page_parts import STYLE, look, script
from ...units import known_units
from .displayed import Displayed
from .drawn import LivePicture
from .inputs import Download
from .parts import Banner, Group, Message, Part

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


class Sheet(anywidget.AnyWidget):
    """Parts below each other, pictures beside them where there is room.

    Its ``banner`` says what is impossible.  What the page shows is the trait ``body``, plain JSON, and the marks of
    each picture in a trait of its own, so that those that stay are not sent again.  What a person does comes as a
    message, one at a time, and of those that wait the newest.
    """

    banner: Banner
    _esm = script("sheet_widget.js")
    _css = STYLE
    body = traitlets.Dict().tag(sync=True)
    setting = traitlets.Dict().tag(sync=True)
    heading = traitlets.Unicode("").tag(sync=True)

    def __init__(self, *children: Part, heading: str = "") -> None:
        self._lock, self._depth, self._waits = threading.RLock(), 0, False
        self._heard = 0
        self.top = Group(*children)
        super().__init__(setting={"look": look(), "units": known_units()}, heading=heading)
        self.on_msg(lambda _, message, buffers: self._hear(message, buffers))
        self._tell()

    def stored(self) -> dict[str, object]:
        """What it shows, as plain JSON that stands in a file."""
        pictures = {picture_of(p): _in_letters(p.data) for p in self.top.inside() if isinstance(p, LivePicture)}
        return {"body": self.body, "heading": self.heading, **pictures}

    @contextmanager
    def held(self) -> Iterator[None]:
        """What changes inside reaches the page together; other threads go on meanwhile, and are heard at its end."""
        with self._lock:
            self._depth += 1
        try:
            yield
        finally:
            with self._lock:
                self._depth -= 1
                if self._waits and not self._depth:
                    self._tell()

    def _tell(self) -> None:
        """The page shows what there is now."""
        with self._lock:
            self._waits = self._depth > 0
            if self._waits:
                return
            parts = list(self.top.inside())
            for part in parts:
                part.changed = self._tell
                if isinstance(part, Download):
                    part.send = self.send
            with self.hold_sync():
                for part in parts:
                    if isinstance(part, LivePicture):
                        self._put_picture(picture_of(part), part.data)
                self.body = {**self.top.described(), "heard": self._heard}

    def _put_picture(self, name: str, marks: list[dict[str, object]]) -> None:
        """The trait of a picture, if it is another one; it is sent as soon as it is there."""
        if name not in self.keys:
            self.add_traits(**{name: traitlets.List(marks).tag(sync=True)})
        elif getattr(self, name) is not marks:
            setattr(self, name, marks)

    def _hear(self, message: Message, buffers: Sequence[memoryview]) -> None:
        """A person has done something with a part; it is always answered."""
        with self.held():
            part = next((p for p in self.top.inside() if p.number == message.get("part")), None)
            try:
                if part:
                    part.take({**message, "buffers": buffers})
            except IMPOSSIBLE as error:
                self.banner.show_message(f"{reason(error)[:1].upper()}{reason(error)[1:]}.")
            except Exception as error:  # somebody's own function: the page stays alive
                self.banner.show_message(f"{raised(error)}.")
            self._heard, self._waits = max(self._heard, int(message.get("count", 0))), True  # views count on


def picture_of(part: Part) -> str:
    """The trait that holds the marks of a picture."""
    return f"picture_{part.number}"


def _in_letters(value: object) -> object:
    """With bytes as letters."""
    if isinstance(value, bytes):
        return {"base64": base64.b64encode(value).decode("ascii")}
    if isinstance(value, Mapping):
        return {name: _in_letters(part) for name, part in value.items()}
    return [_in_letters(part) for part in value] if isinstance(value, list | tuple) else value


class Panel(Displayed, Sheet):
    """A sheet around one live ``picture``; a subclass says in ``summary`` what it shows.

    Its ``banner`` says what is impossible, its ``numbers`` say what the picture shows, where there are any.
    """

    picture: LivePicture

    def __init__(self, *children: Part, heading: str = "") -> None:
        self._followers: list[Callable[..., object]] = []
        super().__init__(*children, heading=heading)

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
        with self.held():
            self.banner.show_message(sentence)
            for part in (self.picture, getattr(self, "numbers", None)):
                if part is not None:
                    part.visible = not sentence

    def drawing(self) -> Callable[[], bytes]:
        """What draws the picture of what is shown now."""
        return self.picture.drawing()
