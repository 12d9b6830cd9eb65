"""A report as PDF: typst lays it out, and no text of a user is its markup."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from contextlib import suppress
from dataclasses import asdict
from importlib.resources import files
from pathlib import Path

from ...quantities.extras import extra
from .pdf import typst_for
from .report_texts import FITS, Fit, Report, shortened
from .written import Made

REPORT = "the report as PDF"


def pdf(report: Report) -> Made:
    """The report on one or two pages, as loose as they have room; what does not fit is said."""
    typst = typst_for(REPORT)
    with extra(REPORT, "report"):
        from matplotlib import get_data_path
    fonts = [Path(get_data_path()) / "fonts" / "ttf"]
    template = files(__package__).joinpath("report.typ").read_bytes()
    for fit in FITS:
        said = shortened(report, fit)
        data = json.dumps(_content(said, fit), ensure_ascii=False)
        made = typst.compile(template, sys_inputs={"report": data}, font_paths=fonts)
        if (pages := len(re.findall(rb"/Type\s*/Page\b", made))) <= fit.pages:
            break
    told = f"a report on {pages} page{'s' * (pages > 1)} of A4"
    return Made(made, told, remarks=(*said.remarks, *missing_letters(data, typst.Fonts(font_paths=fonts).fonts())))


def _content(report: Report, fit: Fit) -> dict[str, object]:
    return {**asdict(report), "fit": fit._asdict(), "beside": report.beside, "width": report.width}


def missing_letters(text: str, fonts: Iterable[object]) -> tuple[str, ...]:
    """A remark if no font of this machine has some letters of ``text``."""
    from matplotlib.font_manager import findfont
    from matplotlib.ft2font import FT2Font

    lacking = {letter for letter in text if letter.isprintable() and not letter.isascii()}
    files = [findfont("DejaVu Sans"), *dict.fromkeys(path for font in fonts if (path := getattr(font, "path", None)))]
    for path in files:
        if not lacking:
            return ()
        with suppress(RuntimeError, OSError):  # a font of a kind that is not read here
            font = FT2Font(path)
            lacking = {letter for letter in lacking if not font.get_char_index(ord(letter))}
    some = " ".join(sorted(lacking)[:8])
    return (f"no font of this machine has {some}: boxes stand in their place until one is installed",)
