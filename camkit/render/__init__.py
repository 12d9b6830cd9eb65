"""The renderer: the only matplotlib, which is loaded with the first still picture."""

from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from ..quantities.extras import extra

if TYPE_CHECKING:
    from .artists import draw_picture as draw_picture
    from .figure import picture as picture
    from .living import to_html as to_html
    from .still import Still as Still
    from .still import draw as draw
    from .still import layout as layout

with extra("camkit.render"):
    if find_spec("matplotlib") is None:
        raise ModuleNotFoundError("no matplotlib", name="matplotlib")

_LATER = {
    "Still": "still",
    "draw": "still",
    "draw_picture": "artists",
    "layout": "still",
    "picture": "figure",
    "to_html": "living",
}
"""Where names live that are loaded when they are first asked for."""

__all__ = [
    "Still",
    "draw",
    "draw_picture",
    "layout",
    "picture",
    "to_html",
]


def __getattr__(name: str) -> Any:
    if name not in _LATER:
        raise AttributeError(f"camkit.render has no {name!r}")
    return getattr(import_module(f".{_LATER[name]}", __name__), name)


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
