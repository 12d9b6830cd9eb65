"""Which sessions belong to a page of searches: to be read from a file, to be searched, to be resumed."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Container, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace

from ...decision import Judgements, Judges
from ...files import Session, designs, sessions
from ...quantities import Analysable, Measure
from ...quantities.kinds import kind_words
from ...search.checkpoint import fingerprint, resume, why
from ...study.free import Free
from ...study.robust import RobustStudy
from ...study.study import Study
from ...study.weighted import WeightedSum
from .search_files import Kept, keep, pending
from .search_job import SIZE, SessionSearch


@dataclass(frozen=True)
class SearchPage:
    """What a page of searches is made of; a session of another page is refused in a sentence.

    ``studies`` are its problems by name, ``space`` the quantities that may be free, ``judged`` what its judgements
    compare (the ``"criteria"`` of a weighted sum, the ``"importance"`` of the objectives), ``offered`` what each
    setting may be, and ``measures`` what its files may name beside the measures of its studies.
    """

    start: Analysable
    """The design that it began with."""
    studies: Mapping[str, Study]
    space: tuple[str, ...]
    judged: Mapping[str, tuple[str, ...]]
    offered: Mapping[str, Container[object]]
    measures: tuple[Measure, ...] = ()

    @property
    def kind(self) -> str:
        """How the names of its searches begin: another page, or this one with another start, has another."""
        page = [repr(self.start), [*self.studies], [*self.space], dict(self.judged)]
        return f"{type(self.start).__name__}-{_short(json.dumps(page))}"

    def study(
        self,
        mode: str,
        design: object,
        space: Free,
        judgements: Mapping[str, Judgements | Judges],
    ) -> Study:
        """One of its problems around a design, with the weights that the judgements of the criteria give."""
        study = self.studies[mode].around(design).freeing(space)
        return study.with_weights(judgements["criteria"].weights) if "criteria" in self.judged else study

    def known_measures(self, now: Session) -> tuple[Measure, ...]:
        """Every measure that a study of this page may have beside those of its mechanism."""
        studies = (now.study, *self.studies.values())
        return (*self.measures, *(measure for study in studies for measure in study.measures))

    # ------------------------------------------------------------ what belongs to it

    def check(self, session: Session) -> None:
        """``ValueError`` for a session that this page cannot show."""
        kinds = {type(session.study.start), type(session.design)}
        if kinds != {type(self.start)}:
            raise ValueError(
                f"the file holds {kind_words(type(session.study.start), article=True)}; "
                f"{kind_words(type(self.start), article=True)} is wanted here"
            )
        self._check_settings(session.search)
        for name, judged in self.judged.items():
            if name in session.judgements and len(session.judgements[name].names) != len(judged):
                raise ValueError(f"the file's judgements are not for {len(judged)} criteria")
        self._check_objectives(session.study)

    def _check_settings(self, settings: Mapping[str, object]) -> None:
        for name, value in settings.items():
            if not isinstance(value, sessions.SETTINGS.get(name, ())) or value not in self.offered[name]:
                raise ValueError(f"the file says {value!r} for {name!r}, which is no setting of this search")

    def _check_objectives(self, study: Study) -> None:
        """The page's judgements weigh the objectives, and the parts of those that are weighted sums."""
        self._check_count("importance", "the study", len(study.minimise), "objective")
        for measure in study.minimise:
            if isinstance(measure, WeightedSum):
                self._check_count("criteria", f"its {measure.name}", len(measure.parts), "part")

    def _check_count(self, name: str, whose: str, count: int, what: str) -> None:
        judged = self.judged.get(name)
        if judged and count != len(judged):
            plural = "" if count == 1 else "s"
            raise ValueError(
                f"{whose} has {count} {what}{plural}; the judgements here weigh {len(judged)}: {', '.join(judged)}"
            )

    def searches_as(self, session: Session) -> bool:
        """Whether a search that was begun under the session is what this page makes of it."""
        with suppress(Exception):  # what is of the same name may have become something else
            same_kind = type(session.design) is type(self.start)
            return same_kind and fingerprint(self._made_here(session).study) == fingerprint(session.study)
        return False

    def _made_here(self, session: Session) -> Session:
        """The session with the study that this page makes of it, as its file would say it."""
        space = {name: bounds for name, bounds in session.study.free.items() if name in self.space}
        study = self.study(session.search["mode"], session.design, space, session.judgements)
        made = replace(session, study=study, front=sessions.empty_front(study))
        try:
            return self._read(designs.to_json(made), made)
        except ValueError:  # a law of one's own, which no file can hold
            return made

    def _read(self, text: str, now: Session) -> Session:
        found: Session = designs.from_json(text, Session, self.known_measures(now))
        return found

    # ------------------------------------------------------------ its searches

    def search(self, session: Session) -> SessionSearch:
        """The search of a session, as its file says it to the last bit; without files, and why, where none can be."""
        if isinstance(session.study, RobustStudy):  # its margins are fitted on the way, and nobody can go on with them
            return SessionSearch(session)
        try:
            text = designs.to_json(session)
            return SessionSearch(self._read(text, session), keep(f"{self.kind}-{_short(text)}", text))
        except OSError as error:
            unkept = why(error)
        except ValueError as refusal:  # a law of one's own, which no file can hold
            unkept = str(refusal)
        return SessionSearch(session, unkept=unkept)

    def can_resume(self) -> bool:
        """Whether a search of this page did not end, and nobody runs it."""
        if kept := pending(self.kind):
            kept.release()
        return kept is not None

    def resume(self, now: Session) -> SessionSearch:
        """The last search that did not end, as it goes on; ``ValueError`` in a sentence where that cannot be."""
        kept = pending(self.kind)
        if kept is None:
            raise ValueError("there is no search that did not end")
        try:
            return SessionSearch(self._session_of(kept, now), kept)
        except ValueError:
            kept.release()
            raise

    def _session_of(self, kept: Kept, now: Session) -> Session:
        """The session of a search that did not end, all checked; ``ValueError`` in a sentence."""
        damaged = ValueError(f"the file {kept.page.name} is damaged; delete it to begin anew")
        try:
            session = self._read(kept.text(), now)
        except ValueError:
            raise damaged from None
        try:
            self.check(session)
            if self.judged.keys() - session.judgements.keys():
                raise damaged
            session = self._made_here(session)
            resume(kept.checkpoint, session.study, *(session.search[name] for name in SIZE))
        except ValueError:
            raise
        except Exception:  # whatever else a file that somebody made can lead to
            raise damaged from None
        return session


def same_design(one: object, other: object) -> bool:
    """Whether two designs are the same in a file, which rounds their last digit."""
    with suppress(ValueError):  # a law of one's own, which no file can hold
        return one == other or designs.to_json(one) == designs.to_json(other)
    return False


def _short(text: str) -> str:
    """A name for a text."""
    return hashlib.sha256(text.encode()).hexdigest()[:12]
