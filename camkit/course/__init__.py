"""A course that checks itself: exercises with numbers of one's own, lessons as notebooks, and their editions."""

from .editions import write_editions
from .exercises import ChoiceExercise, Exercise, NumberExercise, changes
from .given import Range
from .instruments import DesignExercise, FrontExercise, exercise
from .lessons import Lesson, lessons_in, read_lesson
from .records import Progress, learner, progress
from .replies import Reply

__all__ = [
    "ChoiceExercise",
    "DesignExercise",
    "Exercise",
    "FrontExercise",
    "Lesson",
    "NumberExercise",
    "Progress",
    "Range",
    "Reply",
    "changes",
    "exercise",
    "learner",
    "lessons_in",
    "progress",
    "read_lesson",
    "write_editions",
]
