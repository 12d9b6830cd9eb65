"""The pictures of the cards: the first one that each notebook has stored, made small.

Run by `make notebooks`; a notebook without a picture, such as the gallery itself, has no card.
"""

import base64
import io
import json
import sys
from pathlib import Path

from PIL import Image

SIZE = (520, 300)
"""Pixels, at most: twice what a card shows, for dense screens."""


def first_picture(notebook: Path) -> bytes | None:
    """The first PNG among the outputs of a notebook."""
    cells = json.loads(notebook.read_text(encoding="utf-8"))["cells"]
    pictures = (out.get("data", {}).get("image/png") for cell in cells for out in cell.get("outputs", []))
    found = next(filter(None, pictures), None)
    return base64.b64decode("".join(found)) if found else None


def card(picture: bytes) -> bytes:
    """A picture as a PNG of few colours that fits on a card."""
    image = Image.open(io.BytesIO(picture)).convert("RGB")
    image.thumbnail(SIZE, Image.Resampling.LANCZOS)
    made = io.BytesIO()
    image.quantize(64).save(made, "png", optimize=True)
    return made.getvalue()


if __name__ == "__main__":
    folder = Path(sys.argv[1])
    (folder / "images" / "cards").mkdir(exist_ok=True)
    for notebook in sorted(folder.glob("[0-9]*.ipynb"))[1:]:
        if picture := first_picture(notebook):
            (folder / "images" / "cards" / f"{notebook.stem}.png").write_bytes(card(picture))
