"""Many designs, and many seeds: what a share of 1e8 lift designs takes, and thirty seeds by one process and by two.

``python benchmarks/many.py [designs] [generations]``; seconds of this process's processor, and of the clock.
"""

import sys
import time

from camkit.machines import lift_curve_study
from camkit.search import search

STUDY = lift_curve_study()


def run(method, **options):
    """The last step of a search, with the seconds of the processor and of the clock that it took."""
    begun, clock = time.process_time(), time.perf_counter()
    *_, step = search(STUDY, method, **options)
    return step, time.process_time() - begun, time.perf_counter() - clock


def told(what, step, processor, clock):
    print(f"{what:34} {processor:8.2f} s processor {clock:8.2f} s clock, {len(step.front)} designs on the front")


def main(designs=1_000_000, generations=30):
    lines = round(designs ** (1 / len(STUDY.free)))
    run("every", designs=200)  # native code is made
    one, processor, clock = run("every", designs=lines)
    told(f"{one.evaluated} designs", one, processor, clock)
    share = 1e8 / one.evaluated
    print(f"1e8 designs at this rate: {processor * share / 60:.0f} min of the processor, {clock * share / 60:.0f} min")
    two, processor, clock = run("every", designs=lines, jobs=2)
    told("the same with jobs=2", two, processor, clock)
    assert (one.evaluation.x.tobytes(), one.evaluation.f.tobytes()) == (
        two.evaluation.x.tobytes(),
        two.evaluation.f.tobytes(),
    )
    given = {"population": 100, "generations": generations, "seeds": range(30)}
    one, processor, first = run("nsga2", **given)
    told("30 seeds", one, processor, first)
    two, processor, clock = run("nsga2", **given, jobs=2)
    told("30 seeds, jobs=2", two, processor, clock)
    print(f"ratio of the clock {first / clock:.2f}; the same to the last bit: ", end="")
    print(one.evaluation.f.tobytes() == two.evaluation.f.tobytes())


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
