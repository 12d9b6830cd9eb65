"""The exercises of a lesson on paper, with one learner's numbers and room for answers; the key on its last page."""

from __future__ import annotations

import json
from importlib.resources import files
from pathlib import Path

from ..files.workshop.pdf import typst_for
from ..quantities.extras import extra
from ..quantities.markup import plain
from .exercises import ChoiceExercise, Exercise, NumberExercise
from .instruments import DesignExercise
from .lessons import Lesson
from .replies import raised

WORKSHEET = "a worksheet as PDF"


def worksheet(lesson: Lesson, learner: str) -> bytes:
    """The PDF, by typst, the letters as matplotlib brings them; no text of anybody is its markup."""
    typst = typst_for(WORKSHEET)
    with extra(WORKSHEET, "report"):
        from matplotlib import get_data_path
    fonts = [Path(get_data_path()) / "fonts" / "ttf"]
    data = json.dumps(content(lesson, learner), ensure_ascii=False)
    template = files(__package__).joinpath("worksheet.typ").read_bytes()
    made: bytes = typst.compile(template, sys_inputs={"worksheet": data}, font_paths=fonts)
    return made


def content(lesson: Lesson, learner: str) -> dict[str, object]:
    """What stands on the sheet."""
    tasks = [_task(exercise, learner) for exercise in lesson.exercises.values()]
    return {"title": plain(lesson.title), "learner": plain(learner), "tasks": tasks}


def _task(exercise: Exercise, learner: str) -> dict[str, object]:
    numbers = exercise.drawn(learner)
    return {
        "name": plain(exercise.name),
        "question": plain(exercise.said(numbers)),
        "choices": list(map(plain, exercise.choices)) if isinstance(exercise, ChoiceExercise) else [],
        "unit": raised(exercise.unit) if isinstance(exercise, NumberExercise) else "",
        "asks": plain(exercise.asks(numbers)) if isinstance(exercise, DesignExercise) else "",
        "key": plain(exercise.key(numbers)),
    }
