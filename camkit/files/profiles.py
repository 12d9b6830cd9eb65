"""Any table as CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Mapping, Sequence

from ..quantities.kinds import refuse_arguments
from ..quantities.markup import csv_cell
from ..quantities.types import Array


def table_csv(columns: Mapping[str, Sequence[object] | Array]) -> str:
    """Columns of numbers (in the units that their headings name) or words as CSV text, numbers with six decimals.

    >>> print(table_csv({"cam angle [deg]": [0, 1], "lift [mm]": [0.0, 1 / 3]}), end="")
    cam angle [deg],lift [mm]
    0.000000,0.000000
    1.000000,0.333333
    """
    refuse_arguments(table_csv, locals())
    lengths = {len(column) for column in columns.values()}
    if len(lengths) != 1:
        raise ValueError(
            f"the columns have {' and '.join(map(str, sorted(lengths))) or 'no'} rows; they need as many each"
        )
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(map(csv_cell, columns))
    words = ([csv_cell(v) if isinstance(v, str) else f"{v:z.6f}" for v in column] for column in columns.values())
    writer.writerows(zip(*words, strict=True))
    return out.getvalue()
