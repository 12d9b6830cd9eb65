"""The study of the door-handle cam as a program: to record it, to write it for a page, to replay it (one design)."""

import numpy as np

from camkit import door_handle_study
from camkit.program import record
from camkit.program.page import numbers
from camkit.quantities import quantities_of, value_of


def judged(study):
    def function(design):
        found = study.judge(np.empty((1, 0)), design.analyse(study.angles))
        return {"f": found.f, "g": found.g}

    return function


def test_recording(benchmark):
    study = door_handle_study()
    program = benchmark.pedantic(record, (judged(study), study.start), rounds=9, warmup_rounds=2)
    assert len(program.needed) > 1000


def test_writing_for_a_page(benchmark):
    study = door_handle_study()
    program = record(judged(study), study.start)
    assert len(benchmark.pedantic(numbers, (program,), rounds=5, warmup_rounds=1)) < 200_000


def test_replaying(benchmark):
    study = door_handle_study()
    program = record(judged(study), study.start)
    start = {path: value_of(study.start, path) for path in quantities_of(study.start)}
    found = benchmark.pedantic(program, (start,), rounds=9, warmup_rounds=2)
    assert np.array_equal(found["f"], study.evaluate(study.x0).f)
