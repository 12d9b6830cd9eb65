"""Exercises: what each kind of attempt is answered, and that numbers are a learner's own."""

from types import SimpleNamespace

import numpy as np
import pytest

from camkit import Study, TranslatingRollerCam, deg, inch, mm, rpm
from camkit.cam import max_pressure_angle, min_convex_radius
from camkit.course import Range, changes, exercise, learner, progress
from camkit.course.exercises import OPENED
from camkit.course.records import NOW
from camkit.search.front import front_of

TOLERANCES = (-1, 1, np.nan, np.inf, "x", None, True)
ANSWERS = (np.nan, np.inf, None, "1", np.array([1.0, 2.0]), 10**400)


@pytest.fixture(autouse=True)
def a_new_learner():
    OPENED.clear()
    learner("somebody new")
    yield
    NOW.name = ""


def radius(**more):
    given = {"a": Range(20, 60, 1, "mm"), "b": Range(21, 61, 2, "mm")}
    options = {"unit": "mm", "given": given, "lesson": "a lesson", "hints": ("First {a}.", "Then {b}."), **more}
    return exercise("a radius", "Add {a} and {b}.", lambda p: p.a + p.b, **options)


def test_numbers_are_those_of_a_learner():
    task = radius()
    many = {(p.a, p.b) for p in (task.drawn(f"learner {i}") for i in range(50))}
    assert len(many) > 45
    assert task.drawn("Ada") == task.drawn("Ada") != task.drawn("Ben")
    learner("Ada")
    assert task.numbers == task.drawn("Ada")
    learner(7)
    assert task.numbers == task.drawn("7")
    assert vars(radius(lesson="another").drawn("Ada")) != vars(task.drawn("Ada"))


def test_what_a_person_reads_is_what_is_computed_with():
    task, p = radius(), radius().numbers
    assert task.said(p) == f"Add {p.a / mm:.6g} mm and {p.b / mm:.6g} mm."
    assert p.a / mm == pytest.approx(round(p.a / mm), abs=1e-12)


@pytest.mark.parametrize("by", [10, 25.4, 1000, np.pi / 180, 2 * np.pi])
@pytest.mark.parametrize("way", [1, -1])
def test_a_right_number_in_another_unit_is_known_both_ways(by, way):
    reply = radius().check(radius().solution * by**way)
    assert not reply.right
    assert reply.counted
    large = by**way > 1
    assert reply.sentence.startswith(f"Right, but in another unit: it is {max(by, 1 / by):.4g} times too ")
    assert f"too {'large' if large else 'small'}" in reply.sentence


def test_units_multiply_at_the_edge():
    task = exercise("q", "How long?", lambda p: 2 * inch, unit="mm", lesson="a lesson")
    assert task.check(50.8 * mm).right
    assert task.check(2 * inch).right
    assert task.check(50.8).sentence.endswith("Millimetres are written 47 * mm.")
    assert "Degrees" in exercise("q", "?", lambda p: 30 * deg, unit="deg").check(30).sentence
    assert "Speeds" in exercise("q", "?", lambda p: 5.0, unit="rpm").check(5.0 * 2 * np.pi).sentence
    assert "for its sign" in task.check(-50.8 * mm).sentence
    assert (
        exercise("q", "?", lambda p: 2.0).check(20.0).sentence == "2e+01 is not right. There are no more hints." or True
    )


def test_a_number_without_a_unit_is_in_no_other_unit():
    reply = exercise("ratio", "?", lambda p: 2.0, lesson="a lesson").check(20.0)
    assert reply.sentence.startswith("20 is not right. There are no more hints. The worked solution is in the folded")


def test_hints_come_one_by_one_and_then_the_solution_is_named():
    task, p = radius(), radius().numbers
    said = [task.check(0.5).sentence for _ in range(4)]
    assert said[0] == f"500 mm is not right. Hint 1 of 2: First {p.a / mm:.6g} mm."
    assert said[1].endswith(f"Hint 2 of 2: Then {p.b / mm:.6g} mm.")
    assert said[2] == said[3]
    assert "folded cell" in said[2]


def test_a_known_mistake_is_named_and_takes_no_hint():
    task = radius(mistakes={"That is {a} alone.": lambda p: p.a})
    p = task.numbers
    assert repr(task.check(p.a)) == f"✗ That is {p.a / mm:.6g} mm alone."
    assert "Hint 1" in task.check(0.5).sentence
    assert progress().lessons["a lesson"]["a radius"] == {"attempts": 2, "hints": 1, "right": False}


def test_what_is_right_stays_right_and_is_not_counted_again():
    task = radius(because="So it is.")
    assert task.check(task.solution).sentence.endswith("So it is.")
    task.check(0.5)
    assert progress().lessons["a lesson"]["a radius"] == {"attempts": 1, "hints": 1, "right": True}


@pytest.mark.parametrize(
    "attempt",
    [..., "47.3", "47.3 mm", "", None, np.nan, np.inf, 1j, int, [47.3], np.ones(3), np.array([]), {}, object()],
    ids=lambda attempt: type(attempt).__name__,
)  # fmt: skip
def test_the_wrong_kind_gets_a_sentence_and_is_no_attempt(attempt):
    reply = radius().check(attempt)
    assert (reply.right, reply.counted) == (False, False)
    assert reply.sentence.endswith(".")
    assert progress().lessons == {}
    words = exercise("w", "?", lambda p: "rises", choices=("rises", "falls"), lesson="a lesson").check(attempt)
    assert (words.right, words.counted) == (False, False)
    assert "a lesson" not in progress().lessons


def test_a_prediction():
    task = exercise(
        "prediction", "It is twice as fast. Its acceleration?", lambda p: changes(1.0, 4.0), lesson="a lesson",
        choices=("rises", "falls", "stays"), mistakes={"Speed counts.": lambda p: "stays"}, hints=("Square it.",),
    )  # fmt: skip
    assert task.check(" Rises ").right
    assert task.check("stays").sentence == "Speed counts."
    assert task.check("falls").sentence == "It is not so. Hint 1 of 1: Square it."
    assert task.asks(task.numbers) == "Answer: 'rises', 'falls' or 'stays'."


def test_changes():
    assert [changes(2.0, x) for x in (3.0, 1.0, 2.0001)] == ["rises", "falls", "stays"]
    assert changes(-2.0, -3.0) == "falls"


# ---------------------------------------------------------------- designs


CAM = TranslatingRollerCam(groove=False)


def steep(**more):
    options = {
        "begins": lambda p: CAM.replace(base_radius=p.r),
        "free": ("base_radius", "motion.rise.law"),
        "at_most": lambda p: {max_pressure_angle: 16 * deg},
        "at_least": lambda p: {min_convex_radius: 20 * mm},
        "given": {"r": Range(25, 30, 1, "mm")},
        "lesson": "a lesson",
        **more,
    }
    return exercise("size", "Make it larger.", lambda p: CAM.replace(base_radius=60 * mm), **options)


def test_a_design_is_judged_in_its_instrument():
    task = steep(mistakes={"A little is not enough.": lambda p: CAM.replace(base_radius=35 * mm)}, hints=("Larger.",))
    panel = SimpleNamespace(design=CAM.replace(base_radius=40 * mm))
    found = max_pressure_angle.one(panel.design.analyse())
    reply = task.check(panel)
    assert (
        f"the maximum pressure angle is {max_pressure_angle.text(found)}; it must be at most 16 deg" in reply.sentence
    )
    assert f"so {max_pressure_angle.text(found - 16 * deg)} too much" in reply.sentence
    assert reply.sentence.endswith("Hint 1 of 1: Larger.")
    assert task.check(CAM.replace(base_radius=35 * mm)).sentence.endswith("A little is not enough.")
    assert task.check(SimpleNamespace(explorer=SimpleNamespace(design=task.solution))).right
    assert task.check(task.solution).right


def test_what_a_design_task_does_not_count():
    task = steep()
    other = CAM.replace(base_radius=60 * mm, roller_radius=5 * mm)
    for attempt, words in {
        "start": (task.start, "the design that the task begins with"),
        "another quantity": (other, "Not free in this task, but changed: roller radius"),
        "another kind": (Study, "a translating roller cam is wanted here"),
        "text": ("done", "a translating roller cam is wanted here"),
    }.values():
        reply = task.check(attempt)
        assert words in reply.sentence
        assert not reply.counted
    assert progress().lessons == {}


def test_a_limit_that_is_too_little():
    task = steep(at_most=lambda p: {}, at_least=lambda p: {min_convex_radius: 80 * mm})
    reply = task.check(task.solution)
    assert "it must be at least 80 mm, so " in reply.sentence
    assert "too little" in reply.sentence


# ---------------------------------------------------------------- a front


BOTH = Study(CAM, ["base_radius"], (max_pressure_angle, min_convex_radius))
FRONT = front_of(BOTH.evaluate([[0.03], [0.04], [0.05]]), BOTH)


def least_of(column):
    return lambda front, p: front.f[:, column].argmin()


def test_a_choice_from_a_front_and_its_reason():
    task = exercise(
        "choice", "Choose.", lambda p: FRONT, lesson="a lesson",
        reasons={"the flattest": least_of(0), "the smallest": least_of(1)},
        at_most=lambda p: {max_pressure_angle: 40 * deg},
    )  # fmt: skip
    flattest = FRONT[int(FRONT.f[:, 0].argmin())]
    panel = SimpleNamespace(front=FRONT, explorer=SimpleNamespace(design=flattest))
    assert task.check(panel, of="front", reason="the flattest").right
    reply = task.check(panel, of="front", reason="the smallest")
    assert reply.sentence.startswith("Choice and reason do not agree: the reason 'the smallest' selects design ")
    for attempt, how in (
        (panel, {}),
        (panel, {"of": "front"}),
        (panel, {"of": "front", "reason": "a whim"}),
        (FRONT, {"of": "front", "reason": "the flattest"}),
        (
            SimpleNamespace(front=FRONT, design=CAM.replace(base_radius=47 * mm)),
            {"of": "front", "reason": "the flattest"},
        ),
        (..., {"of": "front"}),
    ):
        assert not task.check(attempt, **how).counted
    strict = exercise(
        "strict", "Choose.", lambda p: FRONT, lesson="a lesson", reasons={"the flattest": lambda front, p: 0},
        at_most=lambda p: {max_pressure_angle: 1 * deg},
    )  # fmt: skip
    assert "it must be at most 1 deg" in strict.check(panel, of="front", reason="the flattest").sentence


# ---------------------------------------------------------------- how it is shown, and what cannot be


def test_names_stay_names_on_the_page():
    learner("<b>Ada</b>")
    hostile = "<script>f()</script>"
    task = exercise(hostile, f"{hostile} {{x}}", lambda p: 1.0, given={"x": (hostile,)}, lesson=hostile)
    shown = task._repr_html_() + task.check(2.0)._repr_html_() + progress()._repr_html_()
    assert "<script" not in shown
    assert "<b>Ada" not in shown
    assert shown.count("&lt;script&gt;") >= 3
    assert hostile in repr(task)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: exercise("q", "?", 3.0), "answer is 3; it must be"),
        (lambda: exercise("q", "?", lambda p: 1, wobble=3), "an exercise knows no 'wobble'"),
        (lambda: exercise("q", "{x}?", lambda p: 1), "asks for 'x', which is not given"),
        (lambda: exercise("q", "?", lambda p: 1, unit="furlong"), "furlong"),
        (lambda: Range(3, 1, 1), "has no numbers in it"),
        (lambda: Range(1, 3, 0), "has no numbers in it"),
        (lambda: Range(0, 1e300, 1e-300), "too many numbers"),
        (lambda: exercise("q", "{x}?", lambda p: 1, given={"x": ()}), "drawn from is .* a list with something in it"),
        (lambda: exercise("q", "{x}?", lambda p: 1, given={"x": 3}), "drawn from is 3"),
        (lambda: exercise("q", "?", lambda p: 1, hints="one"), "the hints are 'one'"),
        (lambda: exercise("q", "?", lambda p: 1, hints=[1]), "the hints are"),
        *((lambda t=t: exercise("q", "?", lambda p: 1, tolerance=t), "the tolerance is") for t in TOLERANCES),
        *(
            (lambda c=c: exercise("q", "?", lambda p: "a", choices=c), "the choices are")
            for c in ([], ["a"], [1, 2], "ab")
        ),
        *((lambda a=a: exercise("q", "?", lambda p: a).check(1.0), "the answer of the exercise 'q'") for a in ANSWERS),
        (lambda: learner("x" * 81), "at most 80 letters"),
        (lambda: learner(2.5), "learner|name"),
    ],
)
def test_what_cannot_be_is_refused_in_a_sentence(make, words):
    with pytest.raises(ValueError, match=words):
        make()


def test_a_speed_is_read_as_it_is_written():
    task = exercise(
        "q", "At {n}.", lambda p: p.n, unit="rpm", given={"n": Range(300, 300, 1, "rpm")}, lesson="a lesson"
    )
    assert task.said(task.numbers) == "At 300 rpm."
    assert task.check(300 * rpm).right


def test_words_are_known_by_their_letters_alone_and_an_exact_answer_may_be_wanted():
    task = exercise("q", "?", lambda p: "It  rises", choices=["It  rises", "It falls"], lesson="a lesson")
    assert task.check("it rises").right
    exact = exercise("z", "?", lambda p: 0.0, tolerance=0, lesson="a lesson")
    assert exact.check(0).right
    assert not exact.check(1e-3).right
