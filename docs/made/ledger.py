"""What the papers print beside what the package computes, in one table."""

from collections import Counter
from collections.abc import Iterator

from camkit.papers import Comparison, cabin_door, door_handle, high_speed_cam, shaft, valve_cam
from camkit.quantities.markup import markdown

from .tables import table

PAPERS = {
    "door handle": [
        door_handle.table_1,
        door_handle.table_3,
        lambda: door_handle.table_4("lift"),
        lambda: door_handle.table_4("relief"),
        door_handle.efficiencies,
        door_handle.text_torques,
    ],
    "high-speed cam": [lambda: high_speed_cam.table(1), lambda: high_speed_cam.table(2), high_speed_cam.table_3],
    "valve cam": [valve_cam.normalisers, valve_cam.listing, valve_cam.corners, valve_cam.lifts, valve_cam.sharpest],
    "linkage": [cabin_door.optima, cabin_door.adams, cabin_door.adams_friction],
    "shaft": [shaft.table_1, shaft.table_1_with_rounded_pi, shaft.sag, shaft.global_optimum],
}


def compared() -> Iterator[tuple[str, Comparison]]:
    """Every table of every paper."""
    for paper, tables in PAPERS.items():
        yield from ((paper, made()) for made in tables)


def counted() -> str:
    """How many numbers of each paper are reproduced."""
    rows = []
    for paper in PAPERS:
        verdicts = Counter(row.reproduced for name, found in compared() if name == paper for row in found.rows)
        total = sum(verdicts.values())
        rows.append((paper, total, verdicts[True], verdicts[False], f"{100 * verdicts[True] / total:.0f}"))
    sums = [sum(row[k] for row in rows) for k in (1, 2, 3)]
    rows.append(("**all**", *sums, f"{100 * sums[1] / sums[0]:.0f}"))
    return table(("paper", "numbers", "reproduced", "not reproduced", "reproduced, %"), rows)


def ledger() -> str:
    """Every printed number with its verdict; what is not reproduced in bold."""
    head = ("paper", "table", "quantity", "unit", "beside", "computed", "verdict", "remark")
    rows = []
    for paper, found in compared():
        for row in found.rows:
            name, unit, printed, computed, verdict, remark = map(markdown, row.cells())
            said = verdict if row.reproduced else f"**{verdict}**"
            rows.append((paper, markdown(found.title), name, unit, printed, computed, said, remark))
    return table(head, rows)
