"""The renderer: the only matplotlib.  A picture is drawn the first time and moved the next."""

from ..quantities.extras import extra

with extra("camkit.render"):
    from .draw import draw_picture
    from .living import to_html
    from .picture import Still, draw, layout, picture

__all__ = [
    "Still",
    "draw",
    "draw_picture",
    "layout",
    "picture",
    "to_html",
]
