"""How the benchmarks write what they measured."""

import re


def in_rows(text: str) -> str:
    """Indented JSON with each list of plain values in one row."""
    return re.sub(r"\[[^][{}]*\]", lambda found: " ".join(found[0].split()), text)
