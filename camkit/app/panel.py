"""What every panel shares: a style sheet, and a still picture with numbers where there is no kernel."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import ipywidgets as w

from .picture import LivePicture

CSS = f"<style>{Path(__file__).with_name('panel.css').read_text(encoding='utf-8')}</style>"


class Panel(w.VBox):
    """A column of widgets around one live ``picture``; a subclass says in ``summary`` what it shows."""

    picture: LivePicture

    def __init__(self, children: Sequence[w.Widget]) -> None:
        super().__init__([w.HTML(CSS), *children])
        self.add_class("camkit-panel")

    def summary(self) -> str:
        """The panel's numbers, a line each."""
        raise NotImplementedError

    def _repr_mimebundle_(self, **kwargs: Any) -> dict[str, Any]:
        """The live panel for a kernel, the picture and the numbers where there is none."""
        bundle = super()._repr_mimebundle_(**kwargs)
        data = dict(bundle[0] if isinstance(bundle, tuple) else bundle or {})
        data["image/png"] = base64.b64encode(self.picture.png()).decode("ascii")
        data["text/plain"] = self.summary()
        return data
