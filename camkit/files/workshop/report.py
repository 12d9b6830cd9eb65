"""A report of one or two A4 pages: what a design is, what it does, whether it is good enough, and who says so."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ...quantities.kinds import refuse_arguments
from ...study.study import Study
from .blank import Blank
from .pdf import typst_for
from .report_page import page
from .report_pdf import REPORT, pdf
from .report_texts import BARE, report_of
from .reported import Within, reported
from .title import TitleBlock
from .written import Made, Written, length_unit, new_file, refuse_ending, written

LAYOUTS = {".pdf": pdf, ".html": page}
"""By the ending of the file."""


def report(
    thing: Any,
    ending: str = ".pdf",
    title: TitleBlock = TitleBlock(),
    study: Study | None = None,
    tolerances: Within | None = None,
    unit: str = "mm",
    blank: Blank = BARE,
) -> Made:
    """What `write_report` writes."""
    refuse_ending(ending, "a report", tuple(LAYOUTS))
    if ending == ".pdf":
        typst_for(REPORT)
    return LAYOUTS[ending](report_of(reported(thing, study, tolerances), title, length_unit(unit), blank))


def write_report(
    thing: Any,
    path: str | Path,
    *,
    title: TitleBlock = TitleBlock(),
    study: Study | None = None,
    tolerances: Within | None = None,
    unit: str = "mm",
    blank: Blank = BARE,
) -> Written:
    """Write one or two A4 pages about a design: a ``.pdf`` (extra ``report``) or, in one file, ``.html``.

    ``thing`` is a design, its analysis, a panel, a `Session` or a `Decision`; of these the study and what was decided
    are known.  ``study`` says what is asked of the design, ``tolerances`` (half widths by path, SI, or `Tolerances`)
    what its yield is found with.  Drawing, curves, inputs with units, measures with limits, the verdict, yield, the
    record of the decision, versions and date stand in it; the drawing has the bore of ``blank``.  Lengths are
    in ``unit``, ``"mm"`` or ``"in"`` (then forces in lbf).  What has no room is left out, and the report says so.

    >>> from tempfile import TemporaryDirectory
    >>> from camkit import TranslatingRollerCam
    >>> with TemporaryDirectory() as folder:
    ...     print(write_report(TranslatingRollerCam(), f"{folder}/cam.html", title=TitleBlock(author="M. Curie")))
    cam.html: a report as a page of HTML

    Raises ``ValueError`` for another ending, for what is no design, and for a study or tolerances of another design.
    """
    refuse_arguments(write_report, locals())
    path = new_file(path, "a report", tuple(LAYOUTS))
    return written(report(thing, path.suffix.lower(), title, study, tolerances, unit, blank), path)
