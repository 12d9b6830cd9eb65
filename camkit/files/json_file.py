"""The outside of a saved file: its encoding, what kind of file it is, and whether it is as camkit wrote it.

A file is JSON in UTF-8 with a ``schema`` and a ``digest`` of everything else.  What is of another kind, damaged or
absurdly large is refused by a ``ValueError`` in a sentence; what does not match its digest is read with a remark.
"""

from __future__ import annotations

import hashlib
import json
import re

from ..quantities.kinds import shown

MOST_BYTES = 10_000_000
MOST_ENTRIES = 200_000
MOST_NESTED = 40
"""Lists and objects inside one another; a study of laws that are made of laws needs some fifteen."""
LARGEST = 1e30
"""Larger numbers are no lengths, angles, forces or moduli; their powers would be infinite."""
MOST_DIGITS = 20
"""Of a whole number."""
UNMARKED = "it carries no digest of its content, as files of an earlier camkit do: damage to it would not show"
EDITED = "its content does not match its digest: it was edited or damaged after it was saved; check its numbers"

BINARY = {
    b"\x89PNG": "a PNG picture",
    b"\xff\xd8\xff": "a JPEG picture",
    b"GIF8": "a GIF picture",
    b"%PDF": "a PDF document",
    b"PK\x03\x04": "a ZIP archive or an office document",
    b"\x1f\x8b": "a gzip archive",
}
TEXTS = {
    r"\s*<": "a page of HTML or XML",
    r"\s*(999|0)\s*\n": "a DXF drawing",
    r"[^\n]*[,;\t]": "a table such as CSV",
}
"""What other texts begin with."""

_COMPACT = re.compile(r'("[^"\\]*(?:\\.[^"\\]*)*")|\s+')
_BRACKETS = re.compile(r'"[^"\\]*(?:\\.[^"\\]*)*"|([][{}])')
"""Brackets that are not in a word."""
_DIGEST = re.compile(r'"digest":"[^"]*",?')


def signed(content: dict[str, object]) -> str:
    """``content`` as JSON text with its digest, the first entry (its schema) before it."""
    first, *rest = content
    text = json.dumps({first: content[first], "digest": "", **{k: content[k] for k in rest}}, indent=1, allow_nan=False)
    return text.replace('"digest": ""', f'"digest": "{digest(text)}"', 1)


def digest(text: str) -> str:
    """SHA-256 of a JSON text but for its entry ``digest``, and for spaces and line ends outside of words.

    >>> digest('{"a": 1.50, "digest": "x"}') == digest('{"a":1.50,\\r\\n"digest":""}') != digest('{"a": 1.5}')
    True
    """
    compact = _COMPACT.sub(r"\1", text)
    return hashlib.sha256(_DIGEST.sub("", compact, count=1).encode()).hexdigest()


def content_of(text: str) -> dict[str, object]:
    """The content of a file that says its schema."""
    content = _parsed(text)
    if isinstance(content, dict) and "nbformat" in content:
        raise ValueError("the file is a notebook, no saved design or study")
    if not isinstance(content, dict) or not isinstance(content.get("schema"), str):
        raise ValueError("the file is JSON of another kind: it does not say which camkit schema it follows")
    return content


def digest_remarks(text: str, told: object) -> list[str]:
    """What is to be remarked about a file with the digest ``told``; nothing if it is as it was saved."""
    if told is None:
        return [UNMARKED]
    return [] if told == digest(text) else [EDITED]


def text_of(file: str | bytes) -> str:
    """The text of a file in UTF-8, with or without a byte order mark, that may be JSON."""
    if not isinstance(file, (str, bytes, bytearray, memoryview)):
        raise ValueError(
            f"what is to be read is {shown(file)}; it must be the text of a file, or its bytes (`read` takes a path)"
        )
    data = file.encode("utf-8", "surrogatepass") if isinstance(file, str) else bytes(file)
    if len(data) > MOST_BYTES:
        raise ValueError(f"the file has more than {MOST_BYTES // 10**6} million bytes; no saved design or study has")
    _refuse_binary(data)
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise ValueError(_encoding("not in UTF-8 but perhaps in Latin-1 (Windows-1252)")) from None
    if not text.strip():
        raise ValueError("the file is empty")
    if text.lstrip()[0] not in "{[":
        kind = next((kind for start, kind in TEXTS.items() if re.match(start, text)), "a text of another kind")
        raise ValueError(f"the file is {kind}, no saved design or study")
    return text


def _refuse_binary(data: bytes) -> None:
    for start, kind in BINARY.items():
        if data.startswith(start):
            raise ValueError(f"the file is {kind}, no saved design or study")
    encoding = json.detect_encoding(data)  # by its byte order mark, or by where zeros stand
    if not encoding.startswith("utf-8"):
        raise ValueError(_encoding(f"in {encoding[:6].upper()}"))
    if b"\0" in data:
        raise ValueError("the file is no text, and no saved design or study")


def _encoding(said: str) -> str:
    return f"the file is written {said}; save it as UTF-8"


def _parsed(text: str) -> object:
    """The JSON of a text, each name once, each number finite and of a sane size, nothing nested too deeply."""
    if text.count(",") > MOST_ENTRIES:
        raise ValueError(f"the file has more than {MOST_ENTRIES} entries; no saved design or study has")
    try:
        content = json.loads(
            text, parse_float=_number, parse_int=_whole, parse_constant=_constant, object_pairs_hook=_each_once
        )
    except json.JSONDecodeError as error:
        raise ValueError(f"the file is damaged: it is no JSON at line {error.lineno} ({error.msg})") from None
    except RecursionError:
        content = None
    _refuse_depth(text)
    return content


def _refuse_depth(text: str) -> None:
    depth = 0
    for found in _BRACKETS.finditer(text):
        depth += {"[": 1, "{": 1, "]": -1, "}": -1}.get(found[1], 0)
        if depth > MOST_NESTED:
            raise ValueError("the file is damaged: it is nested too deeply")


def _number(text: str) -> float:
    value = float(text)
    if abs(value) < LARGEST:
        return value
    raise ValueError(f"the file is damaged: it says {text[:40]}; no number of a design is as large")


def _whole(text: str) -> int:
    if len(text) > MOST_DIGITS:
        raise ValueError(f"the file is damaged: it has a whole number of {len(text)} digits")
    return int(text)


def _constant(text: str) -> float:
    raise ValueError(f"the file is damaged: it says {text}; every number must be finite")


def _each_once(pairs: list[tuple[str, object]]) -> dict[str, object]:
    found: dict[str, object] = {}
    for name, value in pairs:
        if name in found:
            raise ValueError(f"the file is damaged: it says {shown(name)} twice")
        found[name] = value
    return found
