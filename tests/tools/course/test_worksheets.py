"""The worksheet of every lesson, read by poppler: each question with the numbers of its learner, and a key."""

import re
import subprocess
from pathlib import Path

import pytest

from camkit.course import read_lesson, write_editions

LESSONS = sorted((Path(__file__).parents[3] / "notebooks/course").glob("[0-9]*.ipynb"))
LEARNER = "Мария #let <b> $x$"


@pytest.mark.parametrize("path", LESSONS, ids=lambda path: path.stem)
def test_a_worksheet_asks_every_question_and_ends_with_the_key(path, tmp_path):
    lesson = read_lesson(path)
    (made,) = write_editions(path, tmp_path, "worksheet", learner=LEARNER)
    said = subprocess.run(["pdftotext", made, "-"], capture_output=True, text=True, check=True).stdout
    pages = said.split("\f")
    asked, key = " ".join(" ".join(pages[:-2]).split()), " ".join(pages[-2].split())
    assert LEARNER in asked
    assert key.startswith("Key for the instructor")
    for exercise in lesson.exercises.values():
        numbers = exercise.drawn(LEARNER)
        assert squeezed(exercise.said(numbers)) in squeezed(asked)
        assert squeezed(exercise.key(numbers)) in squeezed(key)


def squeezed(text):
    """Without blanks and what a line's end may break a word with."""
    return re.sub(r"[\s\u00ad‐-]", "", text)
