"""What papers and standards print, as data files beside their citation: tables to compare with, not to compute from."""

from __future__ import annotations

import json
from importlib.resources import files
from typing import Any

from ..quantities.kinds import shown


def load(name: str) -> Any:
    """The data file ``name``, for instance ``"door_handle"``.

    >>> load("door_handle")["table_3"]["after"]["lift_arm"]
    48.09

    Raises ``ValueError`` for a name that is not there, naming those that are.
    """
    return json.loads(_text(name))


def as_printed(name: str) -> Any:
    """The same with every number as the text that was printed, so that its last digit is known.

    >>> as_printed("door_handle")["table_4"]["lift"]["max_pressure_angle_rad"]["after"]
    '0.720'
    """
    return json.loads(_text(name), parse_float=str, parse_int=str)


def _text(name: str) -> str:
    there = {file.name[:-5]: file for file in files(__package__).iterdir() if file.name.endswith(".json")}
    if not isinstance(name, str) or name not in there:
        raise ValueError(f"there is no reference {shown(name)}; there are {', '.join(sorted(there))}")
    return there[name].read_text(encoding="utf-8")
