"""Where a panel says in a sentence what is impossible."""

from __future__ import annotations

import ipywidgets as w

from ...quantities.markup import attribute, html


class Banner(w.HTML):
    """A sentence that appears when something is impossible; empty otherwise."""

    def __init__(self) -> None:
        super().__init__("", layout=w.Layout(display="none"))
        self.add_class("camkit-banner")

    def show_message(self, sentence: str, role: str = "alert") -> None:
        """Show ``sentence``, or nothing; a "status" is read aloud when there is time, an "alert" at once."""
        self.value = html("<div {}>{}</div>", attribute("role", role), sentence) if sentence else ""
        self.layout.display = "" if sentence else "none"
