"""Every file for the workshop: who takes it, and how far it lies from the exact cam when it is read back."""

from camkit import TranslatingRollerCam
from camkit.files.workshop.exports import EXPORTS, GROUPS, Order
from camkit.quantities.markup import markdown

from .tables import table


def files() -> str:
    """All exports under their headings, each made of one cam; what needs more than this environment says what."""
    order = Order(TranslatingRollerCam(groove=False))
    rows = []
    for export in sorted((e for e in EXPORTS if e.of(order)), key=lambda e: GROUPS.index(e.group)):
        try:
            said = str(export.make(order))
        except ModuleNotFoundError as missing:
            said = str(missing).rpartition(": ")[2]
        rows.append((export.group or "First of all", export.words, f"`{export.ending}`", export.use, markdown(said)))
    return table(("for", "file", "ends in", "who takes it", "what is in one of them"), rows)
