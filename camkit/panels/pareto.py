"""`pareto_panel`: a search in the background, its front, and the choice of one design from it."""

from __future__ import annotations

import hashlib
import json
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

import ipywidgets as w
import numpy as np

from ..decision import CHOOSERS, Judgements
from ..files import Session, designs, sessions
from ..quantities import Measure, Paths, Quantity, words
from ..quantities.kinds import kind_words, refuse_arguments, refuse_empty, whole
from ..quantities.markup import Html, escaped, html, joined
from ..search.checkpoint import fingerprint, resume, why
from ..search.front import Front, front_of, reference_point
from ..search.protocol import Step, search
from ..study.study import Study, WeightedSum, made_study, refuse_bounds
from ..units import in_unit
from ..views.front import ShownFront, pareto, shown_objectives
from .ahp import AhpPanel
from .explore import Explorer, remarked
from .kit.controls import Download, Upload, banner, label_html, show_message, small_html
from .kit.number import NumberBox, WholeBox, staying
from .kit.panel import IMPOSSIBLE, Panel, reason
from .kit.picture import LivePicture
from .kit.running import Job, here, left_behind
from .kit.search_files import Kept, keep, pending

SIZE = ("population", "generations", "seed")

MakeStudy = Callable[..., Study]


class Bounds:
    """One row of the search space: whether a quantity is free, and between which bounds."""

    def __init__(
        self,
        name: str,
        declared: Quantity,
        bounds: tuple[float, float],
        free: bool,
        refused: Callable[[str], None],
    ) -> None:
        self.name, self.declared = name, declared
        narrow = w.Layout(width="84px")
        self.free = w.Checkbox(value=free, indent=False, layout=w.Layout(width="22px"), tooltip="free to change")
        self.low, self.high = (
            NumberBox(0.0, staying(f"bounds of the {words(name)}", refused, "stay"), declared.unit, layout=narrow)
            for _ in range(2)
        )
        self._refused = refused
        self._show(bounds)
        for box in (self.low, self.high):
            box.observe(lambda _: self._check(), "value")
        label = w.HTML(label_html(name, declared), layout=w.Layout(flex="1 1 170px"))
        unit = w.HTML(small_html(declared.unit), layout=w.Layout(width="44px"))
        self.row = w.HBox([self.free, label, self.low, self.high, unit], layout=w.Layout(align_items="center"))
        self.row.add_class("camkit-knob")

    def _show(self, bounds: tuple[float, float]) -> None:
        """Show ``bounds`` (SI), rounded to what fits; as long as nobody edits them they stay exact."""
        self._exact, self._silent = bounds, True
        self.low.value, self.high.value = self._shown = [float(f"{in_unit(b, self.declared.unit):.6g}") for b in bounds]
        self._silent = False

    def _check(self) -> None:
        """Say at once what a search could not take; it stays, since the other bound may be typed next."""
        try:
            refuse_bounds({self.name: self.declared}, {} if self._silent else {self.name: self.value})
        except ValueError as refusal:
            self._refused(f"This cannot be searched: {refusal}.")

    @property
    def value(self) -> tuple[float, float]:
        """The bounds in SI."""
        if [self.low.value, self.high.value] == self._shown:
            return self._exact
        return self.low.value * self.declared.factor, self.high.value * self.declared.factor

    def set(self, bounds: tuple[float, float] | None) -> None:
        """Show other bounds (SI); ``None``: not free."""
        self.free.value = bounds is not None
        if bounds is not None:
            self._show(bounds)


class ParetoPanel(Panel):
    """NSGA-II on the design of an `Explorer`, and the choice from its front.

    ``studies`` maps a name in the menu to a function ``make(start, reference=, space=)`` that gives a `Study`; it
    takes ``weights=`` as well if there are ``criteria`` to judge.  ``importance`` judges the objectives among each
    other.  The search runs in a thread of its own: the page stays alive, Stop takes effect after the running
    generation and keeps the front so far.  Judgements weigh the objectives anew without a new search.

    A panel that is made while a search of its kind runs, because its cell is run again, takes that search over; a
    search of another kind that the cell began is stopped.

    Each generation is kept in a file until the search has ended.  After Stop or a killed kernel, Resume puts the page
    back as it was at Optimise and goes on from the last generation, to the same front as without the break.
    """

    def __init__(
        self,
        explorer: Explorer,
        studies: Mapping[str, MakeStudy],
        space: Mapping[str, tuple[float, float]],
        free: Sequence[str] | Mapping[str, tuple[float, float]],
        criteria: AhpPanel | None = None,
        importance: AhpPanel | None = None,
        population: int = 100,
        generations: int = 100,
    ) -> None:
        refuse_arguments(ParetoPanel.__init__, locals())
        refuse_empty(studies, "studies")
        self.explorer, self.studies, self.criteria, self.importance = explorer, studies, criteria, importance
        declared = Paths(explorer.design, dict.fromkeys((*space, *free)), Quantity).declared
        refuse_bounds(declared, space)
        self._silent = False
        self.bounds = {n: Bounds(n, declared[n], b, n in free, self._refuse) for n, b in space.items()}
        self._make_widgets(population, generations)
        self.study = self._study()
        self._x = np.zeros((0, len(self.study.free)))
        self.front = _front(self.study, self._x)
        self.winner: int | None = None
        self._place, self._unkept = here(), ""
        self._run: _Run | None = None
        self._followers: list[Callable[[], None]] = []
        self.picture = LivePicture((pareto,), "Pareto front", width=7.6, height=4.6)
        self.picture.widget.on_click(self._clicked)
        super().__init__([self._body()])
        for panel in self._judges().values():
            panel.on_change(lambda: None if self._silent else self._judged())
        self._show_front()
        self._offer_resume()
        for job in left_behind(self._kind(), self._place):
            if not (isinstance(job, _Run) and job.kind == self._kind() and self._take_over(job)):
                job.stop()
        explorer.on_change(lambda _: self._show_front() if self._selected() != self._marked else None)

    def _make_widgets(self, population: int, generations: int) -> None:
        style = {"description_width": "92px"}
        self.mode = w.Dropdown(
            options=list(self.studies), description="problem", layout=w.Layout(width="270px"), style=style
        )
        self.population = self._count("population", population, 4, 1000)
        self.generations = self._count("generations", generations, 1, 10000)
        self.seed = self._count("seed", 1, 0, 10**6)
        self.run_button = w.Button(description="Optimise", icon="play", button_style="primary")
        self.stop_button = w.Button(description="Stop", icon="stop", disabled=True)
        self.resume_button = w.Button(
            description="Resume",
            icon="forward",
            disabled=True,
            tooltip="go on with the last search that was stopped or killed",
        )
        self.progress = w.IntProgress(0, 0, 1, layout=w.Layout(width="190px"))
        self.status = w.HTML("not run yet")
        self.status.add_class("camkit-status")
        self.rule = w.Dropdown(
            options=list(CHOOSERS), description="choose by", layout=w.Layout(width="270px"), style=style
        )
        self.pick = w.IntSlider(
            0, 0, 0, description="design", disabled=True, layout=w.Layout(width="430px"), style=style
        )
        self.take = w.Button(description="Load the winner", icon="star", disabled=True)
        self.found, self.verdict, self._banner = w.HTML(), w.HTML(), banner()
        self.run_button.on_click(lambda _: self.run())
        self.stop_button.on_click(lambda _: self.stop())
        self.resume_button.on_click(lambda _: self.resume())
        self.take.on_click(lambda _: self.select(self.winner))
        self.rule.observe(lambda _: None if self._silent else self._show_front(), "value")
        self.pick.observe(lambda change: None if self._silent else self.select(change.new), "value")

    def _count(self, name: str, value: int, low: int, high: int) -> WholeBox:
        whole(value, f"the {name}", low, high)
        layout = w.Layout(width="190px")
        refused = staying(name, self._refuse, "stay" if name == "generations" else "stays")
        return WholeBox(value, low, high, refused, description=name, description_width="92px", layout=layout)

    def _refuse(self, sentence: str) -> None:
        """Why what was typed cannot be; empty where it can."""
        if sentence:
            show_message(self._banner, sentence)
        else:
            self._tell("")

    def _body(self) -> w.Widget:
        save = Download("Save study", "study.json", "application/json", self._json, self._say)
        settings = w.HBox([self.population, self.generations, self.seed], layout=w.Layout(flex_flow="row wrap"))
        buttons = w.HBox(
            [self.run_button, self.stop_button, self.resume_button, self.progress],
            layout=w.Layout(flex_flow="row wrap"),
        )
        rows = [bounds.row for bounds in self.bounds.values()]
        heading = w.HTML("<b>free quantities and their bounds</b>")
        left = [
            self.mode,
            heading,
            *rows,
            settings,
            buttons,
            self.status,
            self.found,
            self._banner,
            w.HBox([save, Upload("Load study", self.load_json)]),
        ]
        right = [self.picture.widget, self.pick, w.HBox([self.rule, self.take]), self.verdict]
        return w.HBox(
            [w.VBox(left, layout=w.Layout(flex="1 1 430px")), w.VBox(right, layout=w.Layout(flex="1 1 480px"))],
            layout=w.Layout(flex_flow="row wrap"),
        )

    def _study(self) -> Study:
        space = {name: bounds.value for name, bounds in self.bounds.items() if bounds.free.value}
        make = self.studies[self.mode.value]
        if not space:
            raise ValueError("no quantity is free; tick one or more")
        weights = {"weights": self.criteria.weights} if self.criteria else {}
        return made_study(make, self.explorer.design, reference=self.explorer.start, space=space, **weights)

    def run(self) -> None:
        """Start the search; returns at once."""
        if self._running():
            return
        try:
            study = self._study()
            session = replace(self.session(), study=study, front=sessions.empty_front(study))
        except IMPOSSIBLE as refusal:
            show_message(self._banner, f"This cannot be searched: {refusal}.")
            return
        self._unkept = ""
        self._begin(*self._new_files(session))

    def resume(self) -> None:
        """Go on with the last search that did not end, under the settings that it had; returns at once."""
        if self._running():
            return
        kept = pending(self._kind())
        try:
            if kept is None:
                raise ValueError("there is no search that did not end")
            session = self._read(kept)
        except ValueError as refusal:
            if kept:
                kept.release()
            show_message(self._banner, f"This cannot be resumed: {refusal}.")
        else:
            self._put_back(session)
            self._unkept = ""
            self._begin(session, kept)

    def _tell(self, message: str) -> None:
        """Say ``message``, and that the search is not kept if it is not."""
        unkept = f"This search is not kept in a file to resume it from: {self._unkept}." if self._unkept else ""
        show_message(self._banner, f"{message}. {unkept}" if message and unkept else message or unkept)

    def _offer_resume(self) -> None:
        kept = pending(self._kind())
        self.resume_button.disabled = kept is None
        if kept:
            kept.release()

    def _running(self) -> bool:
        return self._run is not None and self._run.thread.is_alive()

    def _begin(self, session: Session, kept: Kept | None) -> None:
        self.study = session.study
        run = _Run(self, session, kept)
        self._show_run(run)
        run.start()

    def _show_run(self, run: _Run | None) -> None:
        """The buttons and the bar while a search runs, or after it."""
        self._run = run
        running = run is not None and not run.over
        self.run_button.disabled, self.stop_button.disabled = running, not running
        if running:
            self._tell("")
            self.resume_button.disabled = True
            self.progress.max, self.progress.value = self.generations.value, 0
        else:
            self._offer_resume()

    def _take_over(self, run: _Run) -> bool:
        """Show a search that another panel began, on its page; ``False`` if it is of another study."""
        if type(run.session.design) is not type(self.explorer.start):
            return False
        try:
            same = fingerprint(self._made_here(run.session).study) == fingerprint(run.session.study)
        except Exception:  # what is of the same name has become something else
            return False
        with run.lock:
            if not same or run.over:
                return False
            old, run.panel, run.place = run.panel, self, self._place
            self._put_back(run.session)
            self.study, self._unkept = run.session.study, old._unkept
            self._show_run(run)
            if run.step:
                self._report(run.step, run.reference, last=False)
            old._show_run(None)
            old.status.value = "the search goes on in a newer panel"
        return True

    def _kind(self) -> str:
        """How the names of this page's searches begin: another page, or this one with another start, has another."""
        start = self.explorer.start
        page = [repr(start), [*self.studies], [*self.bounds], {n: p.names for n, p in self._judges().items()}]
        return f"{type(start).__name__}-{_short(json.dumps(page))}"

    def _new_files(self, session: Session) -> tuple[Session, Kept | None]:
        """Where a search is to be kept, and the session to search: as its file says it, to the last bit.

        ``None`` for the files, and a reason, where the search cannot be kept.
        """
        try:
            text = designs.to_json(session)
            return self._reread(text), keep(f"{self._kind()}-{_short(text)}", text)
        except OSError as error:
            self._unkept = why(error)
        except ValueError as refusal:  # a law of one's own, which no file can hold
            self._unkept = str(refusal)
        return session, None

    def _reread(self, text: str) -> Session:
        found: Session = designs.from_json(text, Session, self._measures())
        return found

    def _check_settings(self, settings: Mapping[str, Any]) -> None:
        for name, value in settings.items():
            known = isinstance(value, sessions.SETTINGS.get(name, ()))
            if not known or not _offered(value, getattr(self, name)):
                raise ValueError(f"the file says {value!r} for {name!r}, which is no setting of this search")

    def _check_judgements(self, judgements: Mapping[str, Judgements]) -> None:
        for name, panel in self._judges().items():
            if name in judgements and len(judgements[name].names) != len(panel.names):
                raise ValueError(f"the file's judgements are not for {len(panel.names)} criteria")

    def _check_objectives(self, study: Study) -> None:
        """The page's judgements weigh the objectives, and the parts of those that are weighted sums."""
        if self.importance and len(study.minimise) != len(self.importance.names):
            raise ValueError(_other_count("the study", len(study.minimise), "objective", self.importance))
        for measure in study.minimise:
            if self.criteria and isinstance(measure, WeightedSum) and len(measure.parts) != len(self.criteria.names):
                raise ValueError(_other_count(f"its {measure.name}", len(measure.parts), "part", self.criteria))

    def _read(self, kept: Kept) -> Session:
        """The session of a search that did not end, all checked; ``ValueError`` in a sentence."""
        damaged = ValueError(f"the file {kept.page.name} is damaged; delete it to begin anew")
        try:
            session = self._reread(kept.text())
        except ValueError:
            raise damaged from None
        try:
            self._check_settings(session.search)
            self._check_judgements(session.judgements)
            if self._judges().keys() - session.judgements.keys():
                raise damaged
            session = self._made_here(session)
            resume(kept.checkpoint, session.study, *(session.search[name] for name in SIZE))
        except ValueError:
            raise
        except Exception:  # whatever else a file that somebody made can lead to
            raise damaged from None
        return session

    def _made_here(self, session: Session) -> Session:
        """A session with the study that this page makes of it, as its file would say it."""
        space = {name: bounds for name, bounds in session.study.free.items() if name in self.bounds}
        weights = {"weights": session.judgements["criteria"].weights} if self.criteria else {}
        make = self.studies[session.search["mode"]]
        study = made_study(make, session.design, reference=self.explorer.start, space=space, **weights)
        made = replace(session, study=study, front=sessions.empty_front(study))
        try:
            return self._reread(designs.to_json(made))
        except ValueError:  # a law of one's own, which no file can hold
            return made

    def _put_back(self, session: Session) -> None:
        for name, panel in self._judges().items():
            panel.load(session.judgements[name])
        for name, bounds in self.bounds.items():
            bounds.set(session.study.free.get(name))
        for name, value in session.search.items():
            getattr(self, name).value = value
        self.explorer.load(session.design)

    def stop(self) -> None:
        """Stop after the running generation; the front so far stays."""
        if self._run and self._running():
            self.status.value = "stopping"
            self._run.stop()

    def on_front(self, act: Callable[[], None]) -> None:
        """Call ``act()`` after each new front is shown, from whichever thread shows it."""
        self._followers.append(act)

    def wait(self, seconds: float | None = None) -> None:
        """Until the search has ended."""
        if self._run:
            self._run.thread.join(seconds)

    def _report(self, step: Step, reference: Any, last: bool) -> None:
        self._x = step.front.x
        self.front = step.front if self.study is step.study else step.front.judged_by(self.study)
        self.progress.value = step.number
        if last or not (self._run and self._run.stopping):  # else it says "stopping"
            stopped = last and step.number < step.of
            self.status.value = escaped(
                f"generation {step.number} of {step.of}{' (stopped)' if stopped else ''}: "
                f"{step.feasible} of {len(step.evaluation.x)} feasible, {len(self.front)} on the front, "
                f"hypervolume {self.front.hypervolume(reference):.6g}{'' if last else _left(step)}"
            )
        self._unkept = step.message or self._unkept
        self._tell(self.front.message if last else "")
        self._show_front()

    def _judged(self) -> None:
        """Weigh the same designs anew."""
        if self.criteria:
            self.study = self.study.weighing(self.criteria.weights)
        self.front = replace(_front(self.study, self._x), record=self.front.record)
        self._show_front()

    def _show_front(self) -> None:
        """Nothing is told of a front that cannot be drawn."""
        weights = self.importance.weights if self.importance else None
        winner = CHOOSERS[self.rule.value](self.front, weights) if len(self.front) else None
        selected = self._selected()
        analysis = self.explorer.start.analyse(self.study.angles)
        start = np.array([measure(analysis) for measure in self.study.minimise])
        self.picture.show(ShownFront(self.front, selected, winner, start))
        self.winner, self._marked = winner, selected
        self._silent = True
        self.pick.max, self.pick.disabled = max(len(self.front) - 1, 0), not len(self.front)
        self._silent = False
        self.take.disabled = self.winner is None
        self.verdict.value, self.found.value = self._verdict(), escaped(_told(self.front.record))
        for act in self._followers:
            act()

    def _selected(self) -> int | None:
        """The front's design that is in the sliders, if one is."""
        now = self.study.x_of(self.explorer.design)
        same = np.isclose(self.front.x, now, rtol=1e-9, atol=0).all(-1) if len(self.front) else np.zeros(0, bool)
        return int(np.argmax(same)) if same.any() else None

    def _verdict(self) -> Html:
        if self.winner is None:
            return escaped(self.front.message)
        x, f = self.front.x[self.winner], self.front.f[self.winner]
        free = ", ".join(f"{words(n)} {q.text(v)}" for (n, q), v in zip(self.study.declared.items(), x, strict=True))
        goals = ", ".join(f"{m.name} {m.text(m.sign * v)}" for m, v in zip(self.study.minimise, f, strict=True))
        winner = html("<b>winner: design {}</b> of 0..{}: {}", self.winner, len(self.front) - 1, goals)
        return joined([winner, free], "<br>")

    def select(self, index: int | None) -> None:
        """Load one design of the front into the sliders."""
        if index is None or index >= len(self.front):
            return
        self.explorer.load(self.front[index])
        if self.pick.value != index:
            self.pick.value = index
        self._show_front()

    def _clicked(self, x: float, y: float) -> None:
        if not len(self.front):
            return
        width, height = self.picture.figure.canvas.get_width_height()
        points = self.picture.axes[0].transData.transform(shown_objectives(self.front).T)
        self.select(int(np.argmin(np.hypot(*(points - (x * width, (1 - y) * height)).T))))

    def _judges(self) -> dict[str, AhpPanel]:
        """The judgement panels that there are, by name."""
        panels = {"criteria": self.criteria, "importance": self.importance}
        return {name: panel for name, panel in panels.items() if panel}

    def _json(self) -> str:
        return designs.to_json(self.session())

    def session(self) -> Session:
        """Everything on the page, to be saved."""
        return Session(self.study, self.explorer.design, self._judged_now(), self._settings(), self.front)

    def _settings(self) -> dict[str, Any]:
        return {
            "population": self.population.value,
            "generations": self.generations.value,
            "seed": self.seed.value,
            "mode": self.mode.value,
            "rule": self.rule.value,
        }

    def load(self, session: Session) -> None:
        """Show a saved study: judgements, bounds, front, and the design in the sliders.

        What cannot be judged, computed or drawn here raises ``ValueError`` or ``ArithmeticError``, and all stays as it
        was.
        """
        if type(session.study.start) is not type(self.explorer.start) or type(session.design) is not type(
            self.explorer.start
        ):
            raise ValueError(
                f"the file holds {kind_words(type(session.study.start), article=True)}; "
                f"{kind_words(type(self.explorer.start), article=True)} is wanted here"
            )
        self._check_settings(session.search)
        self._check_judgements(session.judgements)
        self._check_objectives(session.study)
        session.design.analyse()
        self._show_loaded(session)
        for name, bounds in self.bounds.items():
            bounds.set(session.study.free.get(name))
        for name, value in session.search.items():
            getattr(self, name).value = value
        self.status.value = f"loaded: {len(self.front)} designs on the front"

    def _show_loaded(self, session: Session) -> None:
        """Front, judgements and design of a file: all of them or none."""
        before, pick = (self.study, self._x, self.front, self.rule.value, self._judged_now()), self.pick.value
        rule = session.search.get("rule", self.rule.value)
        try:
            self._swap(session.study, session.front.x, session.front, rule, session.judgements)
            (self._judged if session.judgements.keys() & self._judges().keys() else self._show_front)()
            self.explorer.load(session.design)
            if self.explorer.design is not session.design:
                raise ValueError("its design cannot be computed and drawn")
        except Exception:
            self._swap(*before)
            self._show_front()
            self._silent = True
            self.pick.value = pick
            self._silent = False
            raise

    def _judged_now(self) -> dict[str, Judgements]:
        """The judgements on the page."""
        return {name: panel.judgements for name, panel in self._judges().items()}

    def _swap(self, study: Study, x: np.ndarray, front: Front, rule: str, judged: Mapping[str, Judgements]) -> None:
        """Another study, front and judgements, not shown yet."""
        self._silent = True
        try:
            self.study, self._x, self.front, self.rule.value = study, x, front, rule
            for name, panel in self._judges().items():
                if name in judged:
                    panel.load(judged[name])
        finally:
            self._silent = False

    def _say(self, sentence: str) -> None:
        show_message(self._banner, sentence)

    def load_json(self, file: str | bytes) -> None:
        """Show the study that a saved file holds; a file that cannot be used is refused in a sentence."""
        try:
            found = designs.read_json(file, Session, self._measures())
            self.load(found.thing)
        except IMPOSSIBLE as refusal:
            show_message(self._banner, f"This file cannot be used: {reason(refusal)}.")
        else:
            show_message(self._banner, remarked(found))

    def _measures(self) -> tuple[Measure, ...]:
        """Every measure that a study of this page may have beside those of its mechanism."""
        weights = {"weights": self.criteria.weights} if self.criteria else {}
        start, measures = self.explorer.start, [*self.explorer.measures, *self.study.measures]
        for make in self.studies.values():
            with suppress(*IMPOSSIBLE):  # of free quantities that this problem does not have
                study = made_study(make, start, reference=start, space=dict(self.study.free), **weights)
                measures += study.measures
        return tuple(measures)

    def summary(self) -> str:
        """The front's ends and the winner."""
        front, winner = self.front, self.winner
        if winner is None or winner >= len(front):  # a running search may just have found a smaller front
            return f"no front yet; free: {', '.join(map(words, self.study.free))}"
        f = front.f[winner]
        goals = (f"{m.name}: {m.text(m.sign * v)}" for m, v in zip(self.study.minimise, f, strict=True))
        return "\n".join([f"{len(self.front)} designs on the front; winner by {self.rule.value}:", *goals])


def _front(study: Study, x: np.ndarray) -> Front:
    """The front among designs ``(p, n_free)``, which may be none."""
    return front_of(study.evaluate(x), study) if len(x) else Front(study, x, np.zeros((0, len(study.minimise))))


def _other_count(whose: str, count: int, what: str, panel: AhpPanel) -> str:
    """Why judgements do not weigh what a file holds."""
    plural = "" if count == 1 else "s"
    return f"{whose} has {count} {what}{plural}; the judgements here weigh {len(panel.names)}: {', '.join(panel.names)}"


def _offered(value: Any, control: Any) -> bool:
    """Whether a menu or a box of whole numbers takes a value."""
    return value in control.options if hasattr(control, "options") else control.min <= value <= control.max


class _Run(Job):
    """A search, the session that asked for it, and the ``panel`` that shows it, which may change."""

    def __init__(self, panel: ParetoPanel, session: Session, kept: Kept | None) -> None:
        super().__init__(panel._kind(), panel._place, self._search, self._report, self._finish)
        self.lock, self.over = threading.RLock(), False
        self.panel, self.session, self._kept = panel, session, kept
        self.reference: Any = None

    def _search(self) -> Iterator[Step]:
        self.reference = reference_point(self.session.study)
        checkpoint = self._kept.checkpoint if self._kept else None
        return search(
            self.session.study, "nsga2", checkpoint=checkpoint, **{name: self.session.search[name] for name in SIZE}
        )

    def _report(self, step: Step, last: bool) -> None:
        """To whichever panel shows the search."""
        with self.lock:
            self.panel._report(step, self.reference, last)

    def _finish(self, error: Exception | None) -> None:
        if error:
            show_message(self.panel._banner, f"The search ended early: {error}.")
        with self.lock:
            self.over = True
            if self._kept:
                ended = self.step and self.step.number == self.step.of
                self._kept.remove() if ended and not error else self._kept.release()
            self.panel._show_run(self)


def _left(step: Step) -> str:
    """How long a search still takes, in words."""
    left = step.seconds_left
    return f", {left:.0f} s left" if left < 90 else f", {left / 60:.0f} min left"


def _told(record: Mapping[str, Any]) -> str:
    """How a front was found, in one line; all that is known of it is in the saved study."""
    words_of = {"generations": "{} generations", "designs": "{} designs looked at", "seed": "seed {}"}
    told = (said.format(record[name]) for name, said in words_of.items() if name in record)
    return f"found in {record['seconds']:.3g} s: {', '.join(told)}" if record else ""


def _short(text: str) -> str:
    """A name for a text."""
    return hashlib.sha256(text.encode()).hexdigest()[:12]


def pareto_panel(
    explorer: Explorer,
    studies: Mapping[str, MakeStudy],
    space: Mapping[str, tuple[float, float]],
    free: Sequence[str] | Mapping[str, tuple[float, float]],
    **options: Any,
) -> ParetoPanel:
    """A panel that searches around the design in ``explorer`` and helps to choose from the front."""
    return ParetoPanel(explorer, studies, space, free, **options)
