"""Every lesson, attempted as learners do: the right answer, known mistakes, numbers in other units, guesses."""

import ast
import json
import re
from pathlib import Path
from types import SimpleNamespace

import pytest

from camkit import deg, mm
from camkit.course import ChoiceExercise, DesignExercise, FrontExercise, NumberExercise, learner, read_lesson
from camkit.course.exercises import OPENED
from camkit.course.lessons import attempted, source, tags
from camkit.course.records import NOW

FOLDER = Path(__file__).parents[2] / "notebooks/course"
LESSONS = {path.stem: read_lesson(path) for path in sorted(FOLDER.glob("[0-9]*.ipynb"))}
EXERCISES = {f"{lesson}: {name}": task for lesson, each in LESSONS.items() for name, task in each.exercises.items()}
LEARNERS = [f"learner {i}" for i in range(60)]
FEW = LEARNERS[:6]
"""For what takes long: designs are analysed."""


def of(kind):
    return pytest.mark.parametrize("task", [t for t in EXERCISES.values() if isinstance(t, kind)], ids=lambda t: t.name)


@pytest.fixture
def somebody():
    """A new learner, whose attempts are counted from the first."""

    def named(name):
        NOW.lessons = {}
        OPENED.clear()
        learner(name)

    yield named
    NOW.name, NOW.lessons = "", {}


def sentence(task, words, numbers):
    """A known mistake's sentence with the numbers of a learner."""
    return words.format(**task.words(numbers))


# ---------------------------------------------------------------- numbers


@of(NumberExercise)
def test_no_two_answers_are_the_same_number(task):
    """For nobody does a mistake give what is right, what is right in another unit, or another mistake."""
    assert len(task.mistakes) >= 2
    for name in LEARNERS:
        p = task.drawn(name)
        assert task.judge(task.answer(p), p).right
        for words, made in task.mistakes.items():
            reply = task.judge(made(p), p)
            assert not reply.right
            assert reply.sentence == sentence(task, words, p), name


@of(NumberExercise)
def test_numbers_are_too_many_to_copy(task):
    answers = {f"{task.answer(task.drawn(name)):.6g}" for name in LEARNERS}
    assert len(answers) > 30


@of(NumberExercise)
@pytest.mark.parametrize("name", FEW)
def test_a_number_is_answered(task, name, somebody):
    somebody(name)
    right, first = task.solution, task.hints[0].format(**task.words(task.numbers))
    guess = task.check(1.73 * right)
    assert guess.sentence == f"{task.text(1.73 * right)} is not right. Hint 1 of {len(task.hints)}: {first}"
    if task.unit:
        assert "1000 times too small" in task.check(right * mm).sentence
        assert "Degrees are written" in task.check(right * deg).sentence
    assert not task.check(f"{right}").counted
    for words, made in task.mistakes.items():
        assert task.check(made(task.numbers)).sentence == sentence(task, words, task.numbers)
    for _ in task.hints[1:]:
        assert "Hint" in task.check(1.73 * right).sentence
    assert "The worked solution is in the folded cell" in task.check(1.73 * right).sentence
    assert repr(task.check(right * (1 + 0.5 * task.tolerance))).startswith(f"✓ Right: {task.text(right)}.")


# ---------------------------------------------------------------- words


@of(ChoiceExercise)
def test_a_word_is_answered(task, somebody):
    right = set()
    for name in LEARNERS:
        somebody(name)
        p = task.numbers
        right.add(task.solution)
        assert task.solution in task.choices
        known = {made(p): sentence(task, words, p) for words, made in task.mistakes.items()}
        for choice in task.choices:
            reply = task.judge(choice, p)
            assert reply.right == (choice == task.solution)
            if choice != task.solution:
                assert reply.sentence == known.get(choice, "It is not so.")
    assert len(right) > 1  # nobody's answer can be taken for one's own


@of(ChoiceExercise)
@pytest.mark.parametrize("name", FEW)
def test_wrong_words_get_a_hint(task, name, somebody):
    somebody(name)
    wrong = [choice for choice in task.choices if choice != task.solution]
    unknown = [choice for choice in wrong if not task.judge(choice, task.numbers).known]
    for choice in unknown[:1]:
        assert "Hint 1" in task.check(choice).sentence
    assert not task.check("perhaps").counted
    assert task.check(task.solution.upper()).right


# ---------------------------------------------------------------- designs


@of(DesignExercise)
@pytest.mark.parametrize("name", FEW)
def test_a_design_is_answered(task, name, somebody):
    somebody(name)
    assert len(task.mistakes) >= 2
    assert not task.check(task.start).counted
    for words, made in task.mistakes.items():
        reply = task.check(made(task.numbers))
        assert reply.sentence.startswith("Not yet: the ")
        assert "it must be at " in reply.sentence
        assert reply.sentence.endswith(sentence(task, words, task.numbers))
    assert not task.check("it is done").counted
    reply = task.check(task.solution)
    assert reply.sentence.startswith("Right: the ")
    assert reply.right


@of(FrontExercise)
@pytest.mark.parametrize("name", FEW)
def test_a_choice_from_a_front_is_answered(task, name, somebody):
    somebody(name)
    front, p = task.solution, task.numbers
    places = {reason: int(select(front, p)) for reason, select in task.reasons.items()}
    assert len(set(places.values())) >= 2
    for reason, place in places.items():
        for other, at in places.items():
            reply = task.check(SimpleNamespace(front=front, design=front[at]), of="front", reason=other)
            assert reply.sentence.startswith(f"Right: design {at} of {len(front)} is the one that the reason {other!r}")
            reply = task.check(SimpleNamespace(front=front, design=front[place]), of="front", reason=other)
            assert reply.right == (place == at)
            agree = f"the reason {other!r} selects design {at}, and design {place} is in the sliders"
            assert reply.right or agree in reply.sentence
        assert f"{reason}: design {place}" in task.key(p)
    panel = SimpleNamespace(front=front, design=front.study.start)
    assert not task.check(panel, of="front", reason=next(iter(places))).counted
    assert not task.check(panel, of="front").counted
    assert not task.check(panel).counted


# ---------------------------------------------------------------- the notebooks


@pytest.mark.parametrize("lesson", LESSONS.values(), ids=list(LESSONS))
def test_a_lesson_has_what_a_lesson_needs(lesson):
    text = "\n".join(source(cell) for cell in lesson.cells if cell["cell_type"] == "markdown")
    assert 4 <= len(lesson.exercises) <= 6
    assert "**A question from practice.**" in text
    assert re.search(r"\*\*For the instructor: \d\d minutes\.\*\*", text)
    assert "*Common mistakes*" in text
    assert "projector" in text
    assert "published table" in text
    assert "*Sources*" in text or "*Source*" in text
    assert not re.search(r"\]\((?!https?:)", text)  # an edition stands in another folder
    code = [cell for cell in lesson.cells if cell["cell_type"] == "code"]
    asked = [found[0] for cell in code if "solution" not in tags(cell) and (found := attempted(source(cell)))]
    solved = "\n".join(source(cell) for cell in code if "solution" in tags(cell))
    assert sorted(asked) == sorted(lesson.exercises)  # each has one cell for the learner's attempt
    assert [name for name in lesson.exercises if f"{name}.check(" not in solved] == []


@pytest.mark.parametrize("lesson", LESSONS.values(), ids=list(LESSONS))
def test_its_cells_say_what_they_are_for(lesson):
    folded = [cell for cell in lesson.cells if cell["metadata"].get("jupyter", {}).get("source_hidden")]
    for cell in lesson.cells:
        kind = tags(cell)
        assert kind <= {"exercise", "solution", "instructor"}
        if cell["cell_type"] == "code" and kind & {"exercise", "solution"}:
            assert cell in folded
        if cell["cell_type"] == "code" and cell not in folded:
            assert len(source(cell).splitlines()) <= 10
    assert {each for cell in lesson.cells for each in tags(cell)} == {"exercise", "solution", "instructor"}
    first = next(i for i, cell in enumerate(lesson.cells) if "widget-view" in json.dumps(cell.get("outputs", "")))
    assert first < next(i for i, cell in enumerate(lesson.cells) if "exercise" in tags(cell))  # the instrument first


@pytest.mark.parametrize("lesson", LESSONS.values(), ids=list(LESSONS))
def test_exercises_belong_to_their_lesson(lesson):
    assert {task.lesson[:2] for task in lesson.exercises.values()} == {lesson.name[:2]}
    assert len({task.lesson for task in lesson.exercises.values()}) == 1
    assert all(task.hints for task in lesson.exercises.values())
    ast.parse(lesson.definitions)
