"""Text made for other readers: HTML, Markdown, CSV.  A name stays a name in each of them.

Whatever is not `Html` yet is escaped on its way into HTML, so that nothing but this package's own code makes elements:

>>> html("<b>{}</b>", "a < b")
'<b>a &lt; b</b>'
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Sequence
from html import escape


class Html(str):
    """Text that is HTML already."""

    __slots__ = ()


def escaped(text: object) -> Html:
    """``text`` as HTML shows it letter by letter in an element; in an attribute see `attribute`.

    >>> escaped("<script>f()</script>")
    '&lt;script&gt;f()&lt;/script&gt;'
    """
    return text if isinstance(text, Html) else Html(escape(_visible(text), quote=False))


def attribute(name: str, text: object) -> Html:
    """An attribute of an element, whatever its text holds.

    >>> html("<i {}>{}</i>", attribute("title", "l'arm"), "l'arm")
    "<i title='l&#x27;arm'>l'arm</i>"
    """
    return Html(f"{name}='{escape(_visible(text), quote=True)}'")


def html(template: str, *parts: object, **named: object) -> Html:
    """``template``, which is HTML, with every part that is not `Html` escaped."""
    return Html(template.format(*map(escaped, parts), **{name: escaped(part) for name, part in named.items()}))


def joined(parts: Iterable[object], between: str = "") -> Html:
    """Parts one after the other with ``between``, which is HTML, between them.

    >>> joined(["x < 1", html("<i>{}</i>", "y")], "<br>")
    'x &lt; 1<br><i>y</i>'
    """
    return Html(between.join(map(escaped, parts)))


def table(head: Sequence[object], rows: Iterable[Sequence[object]], caption: object = "", style: str = "") -> Html:
    """An HTML table; ``style`` is that of every cell.

    >>> table(["law"], [["a & b"]])
    '<table><tr><th>law</th></tr><tr><td>a &amp; b</td></tr></table>'
    """
    told = html("<caption>{}</caption>", caption) if caption else ""
    return Html(
        f"<table>{told}{_row('th', head, style) if head else ''}{joined(_row('td', r, style) for r in rows)}</table>"
    )


def _row(kind: str, cells: Iterable[object], style: str) -> Html:
    opened = html("<{} {}>", kind, attribute("style", style)) if style else f"<{kind}>"
    return Html(f"<tr>{''.join(f'{opened}{escaped(cell)}</{kind}>' for cell in cells)}</tr>")


_MARKDOWN = {c: f"\\{c}" for c in "\\`*_[]#|~"} | {"&": "&amp;", "<": "&lt;", ">": "&gt;", "$": "&#36;"}


def markdown(text: object) -> str:
    r"""``text`` in one line that Markdown shows letter by letter, also in a cell of a table.

    >>> markdown("a_b | <c>")
    'a\\_b \\| &lt;c&gt;'
    """
    return "".join(_MARKDOWN.get(c, c) for c in _one_line(text))


_FORMULA = re.compile(r"\s*[=+\-@＝＋－＠]")
_INNER_FORMULA = re.compile(r";(?=[\s\"]*[=+\-@＝＋－＠])")
"""Where a spreadsheet that separates cells by semicolons would begin one."""


def csv_cell(text: object) -> str:
    """``text`` in one line that no spreadsheet takes for a formula; a number stays as it is.

    >>> csv_cell("=1+1"), csv_cell("-3.5"), csv_cell("-least radius")
    ("'=1+1", '-3.5', "'-least radius")

    Some spreadsheets separate by semicolons, whatever the file does; what they would begin is no formula either:

    >>> csv_cell("x;=1+1")
    "x;'=1+1"
    """
    line = _INNER_FORMULA.sub(";'", _one_line(text))
    return f"'{line}" if _FORMULA.match(line) and not _is_number(line) else line


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _one_line(text: object) -> str:
    """Control characters, tabs and ends of lines as blanks."""
    return re.sub(r"[\x00-\x1f\x7f-\x9f\u2028\u2029]+", " ", _visible(text))


def plain(text: object) -> str:
    """``text`` in one line of letters that show, which a file of any kind can hold.

    >>> plain("two\\nlines\\ud800 \u51f8\u8f6e")
    'two lines \u51f8\u8f6e'
    """
    return " ".join("".join(c if c.isprintable() else " " for c in _visible(text)).split())


def _visible(text: object) -> str:
    """``text`` without half letters, and what shows nothing but changes what is around it: the direction of writing."""
    said = str(text)
    return said if said.isascii() else "".join(c for c in said if unicodedata.category(c) not in ("Cf", "Cs"))


def words(name: str) -> str:
    """A field's name as it is read: ``lift_arm`` -> ``lift arm``, ``load.max_force`` -> ``load maximum force``."""
    read = name.replace("_", " ").replace(".", " ").split()
    return " ".join({"min": "minimum", "max": "maximum"}.get(word, word) for word in read)


GREEK = re.findall(
    "[a-z]+",
    "alpha beta gamma delta epsilon zeta eta theta iota kappa lambda mu nu xi omicron pi rho final sigma tau upsilon "
    "phi chi psi omega",
)
SUBSCRIPTS = dict(zip("0123456789aehijklmnoprstuvx", "₀₁₂₃₄₅₆₇₈₉ₐₑₕᵢⱼₖₗₘₙₒₚᵣₛₜᵤᵥₓ", strict=True))
RAISED = {**dict(zip("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹", strict=True)), "-": "⁻", ".": "·", "+": ""}


def letters(text: str) -> str:
    """A symbol, or a text in which symbols stand, with the literature's letters, as the page writes them.

    >>> letters("psi_0"), letters("F_sigma  [N^0.5 mm^-0.5]"), letters("lift_arm"), letters("h_max")
    ('ψ₀', 'Fσ  [N⁰·⁵ mm⁻⁰·⁵]', 'lift_arm', 'hₘₐₓ')
    """
    text = re.sub(r"\b([A-Za-z]+)_([A-Za-z0-9]+)\b", _indexed, text)
    text = re.sub(r"[A-Za-z]+", lambda word: _greek(word[0]), text)
    return re.sub(r"\^([+-]?[\d.]+)", lambda power: "".join(RAISED[c] for c in power[1]), text)


def _indexed(word: re.Match[str]) -> str:
    """A letter with its index below it, if there is such a small letter; what is no letter stays a name."""
    letter, index = _greek(word[1]), _greek(word[2])
    if len(letter) > 1:
        return word[0]
    return letter + ("".join(SUBSCRIPTS[c] for c in index) if {*index} <= SUBSCRIPTS.keys() else index)


def _greek(name: str) -> str:
    """A letter by its name, small or large."""
    small = name[0].lower() + name[1:]
    if small not in GREEK or small == "final":
        return name
    return chr((0x3B1 if small == name else 0x391) + GREEK.index(small))
