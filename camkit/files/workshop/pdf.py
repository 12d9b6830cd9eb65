"""SVG sheets as the pages of a PDF, every line a line and every text a text, by typst."""

from __future__ import annotations

from collections.abc import Sequence
from types import ModuleType

from ...quantities.extras import extra

DRAWING = "a drawing as PDF"


def typst_for(what: str) -> ModuleType:
    """What makes PDFs; where it is not installed a sentence says so, before ``what`` is worked out."""
    with extra(what, "report"):
        import typst
    return typst


def pdf_of(sheets: Sequence[str], size: tuple[float, float]) -> tuple[bytes, tuple[str, ...]]:
    """A PDF with a page of a size (mm) for each sheet, and a remark where no font of this computer has a letter.

    It is a PDF/A-2b, made to be kept, unless there is such a letter.
    """
    typst = typst_for(DRAWING)
    width, height = size
    lines = [f"#set page(width: {width}mm, height: {height}mm, margin: 0pt)"]
    for i in range(len(sheets)):
        lines.append(f'#image(bytes(sys.inputs.at("{i}")), format: "svg", width: {width}mm, height: {height}mm)')
    source, given = "\n".join(lines).encode(), {str(i): sheet for i, sheet in enumerate(sheets)}
    try:
        return typst.compile(source, sys_inputs=given, pdf_standards=["a-2b"]), ()
    except typst.TypstError as refusal:
        return typst.compile(source, sys_inputs=given), (f"it is no PDF/A, which is kept for long: {refusal}",)
