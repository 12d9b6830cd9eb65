"""The command line: ``camkit lab``, ``app``, ``check``, ``export``, ``optimise``, ``schema``.

Each says in a sentence on stderr what it cannot do, and ends with a number: 0, it is done and nothing is wrong; 1, the
design is faulty, or none keeps every limit; 2, the command or a file cannot be read; 130, it was stopped.
"""

from __future__ import annotations

import argparse
import math
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import suppress
from dataclasses import fields, replace
from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

from .course.editions import EDITIONS, WORKSHEET, write_editions
from .files import Blank, Decision, Session, TitleBlock, faults, to_json, to_workshop
from .files.designs import read_json
from .files.json_file import MOST_BYTES
from .files.schema import text as schema_text
from .files.workshop.exports import EXPORTS, TABLES, Export, Order, exports_of
from .files.workshop.faults import verdicts
from .files.workshop.written import length_unit, written
from .quantities import Analysable, choices_of, measures_of, quantities_of, words
from .quantities.applied import a_new_file
from .search import Front, Step, front_of, search
from .search.checkpoint import remove_parts, write_whole
from .search.protocol import METHODS
from .search.robust_front import surviving
from .study.robust import RobustStudy
from .study.study import Study
from .units import factor
from .units.typed import typed_number
from .workbook import app, ask_where, lab

DONE, FAULTY, UNREADABLE, STOPPED = 0, 1, 2, 130
EVERY = 1.0
"""Seconds between two lines of progress."""
EXAMPLES = """
examples:
  camkit lab                                   the notebooks in ./camkit-notebooks, opened in JupyterLab
  camkit lab work --port 8899 --no-browser     in the folder work; what is not known here goes to JupyterLab
  camkit app work                              the notebooks as pages without code
  camkit check cam.json                        what it measures, which limits it keeps, what is wrong with it
  camkit export cam.json --dxf --unit in       one file, beside the others of its name
  camkit export cam.json --table radii motion  tables, by their kinds
  camkit export cam.json --all --out made      every file that can be made of it, in the folder made
  camkit export cam.json --zip --bore 20mm --key "DIN 6885-1" --author "M. Curie"
  camkit optimise study.json --seed 1 --generations 200 --out found.json
  camkit course notebooks/course --edition learner worksheet --learner "Class 3b"
  camkit schema                                the JSON Schema of these files

exit codes:
  0  done, and nothing is wrong     1  the design is faulty, or none keeps every limit
  2  the command or a file cannot be read     130  stopped
"""

KINDS = "kinds of tables:\n" + "\n".join(f"  {each.key:10}  {each.words}, {each.use}" for each in TABLES) + "\n"


class Opened(NamedTuple):
    """What a file holds: a design, and what is asked of it, if that is known."""

    design: Analysable
    session: Session | None

    @property
    def study(self) -> Study | None:
        """What is asked of the design."""
        return self.session.study if self.session else None


def opened(path: str) -> Opened:
    """The design in a file, or that of a study, a front or a decision; remarks go to stderr."""
    with open(path, "rb") as file:
        data = file.read(MOST_BYTES + 1)
    try:
        found = read_json(data)
    except ValueError as refusal:
        raise ValueError(f"{path}: {refusal}") from None
    for remark in found.remarks:
        print(f"{path}: {remark}", file=sys.stderr)
    thing = found.thing
    if isinstance(thing, Decision):
        return Opened(thing.design, Session(thing.front.study, thing.design, front=thing.front))
    if isinstance(thing, Front):
        thing = Session(thing.study, thing.study.start, front=thing)
    if isinstance(thing, Session):
        return Opened(thing.design, thing)
    if not hasattr(thing, "analyse"):
        raise ValueError(f"{path} holds no design; one, or a study, a front or a decision, is wanted here")
    return Opened(thing, None)


# ---------------------------------------------------------------- check


def check(asked: argparse.Namespace) -> int:
    """Say what a design measures, which limits it keeps and what is wrong with it."""
    design, study = (found := opened(asked.file)).design, found.study
    print(f"{type(design).__name__}, {asked.file}")
    rows = [*_measured(design, study)]
    width = max((len(name) for name, _, _ in rows), default=0)
    for name, value, limit in rows:
        print(f"  {name:{width}}  {value}{limit and f'  ({limit})'}")
    if isinstance(study, RobustStudy):
        around = study.around(design)
        print(f"  yield {around.recheck(around.x0[None])}, at least {100 * study.wanted:.4g} %")
    wrong = faults(design, study)
    for fault in wrong:
        print(f"FAULTY: {fault}")
    if not wrong:
        print("nothing is wrong with it")
    return FAULTY if wrong else DONE


def _measured(design: Analysable, study: Study | None) -> Iterator[tuple[str, str, str]]:
    """Every measure of a design: name, value, and its limits with whether they are kept."""
    analysis, judged = design.analyse(), [*verdicts(study.around(design).nominal)] if study else []
    for measure in dict.fromkeys((*measures_of(design), *(each.measure for each in judged))):
        limits = (f"{e.bound}, {'kept' if e.kept else 'missed'}" for e in judged if e.measure == measure)
        value = measure.one(analysis)
        yield measure.name, measure.text(value) if math.isfinite(value) else "none", "; ".join(limits)


# ---------------------------------------------------------------- export


def export(asked: argparse.Namespace) -> int:
    """Write the files that are asked for."""
    found, folder = opened(asked.file), Path(asked.out)
    order = _order(asked, found)
    there = exports_of(order)
    chosen = [each for each in there if asked.all or each.key in (*asked.files, *asked.table)]
    if lacking := {*asked.files, *asked.table} - {each.key for each in there}:
        raise ValueError(f"of a {order.kind} there is no {', '.join(sorted(lacking))}; there can be {_options(there)}")
    if not (chosen or asked.zip):
        raise ValueError(f"no file is asked for; of a {order.kind} there can be {_options(there)}, --all or --zip")
    wrong = faults(order.design, order.study, order.tolerances, blank=order.blank)
    if wrong and not asked.insist:
        print(
            f"FAULTY: {'; '.join(wrong)}; nothing is written; --insist writes it, marked on every sheet",
            file=sys.stderr,
        )
        return FAULTY
    folder.mkdir(parents=True, exist_ok=True)
    order = replace(order, title=replace(order.title, faults=wrong))
    if asked.zip:
        print(_zip(order, folder, asked.insist))
    missing = [sentence for each in chosen if (sentence := _export(each, order, folder))]
    return UNREADABLE if missing and not asked.all else DONE


def _zip(order: Order, folder: Path, insist: bool) -> object:
    title = replace(order.title, faults=())
    return to_workshop(
        order.design,
        folder / f"{order.kind}.zip",
        study=order.study,
        unit=order.unit,
        title=title,
        blank=order.blank,
        tool_radius=order.tool_radius,
        insist=insist,
    )


def _export(each: Export, order: Order, folder: Path) -> str:
    """Write one file and say what it is; why it could not be made."""
    try:
        print(written(each.make(order), folder / f"{order.kind}{each.ending}"))
    except (ValueError, ModuleNotFoundError) as refusal:
        print(f"{each.words} ({each.ending}): {refusal}", file=sys.stderr)
        return str(refusal)
    return ""


def _order(asked: argparse.Namespace, found: Opened) -> Order:
    """What is asked for, with what the sheets are to say."""
    unit = length_unit(asked.unit)
    title = TitleBlock(**{name: getattr(asked, name) for name in _titles()})
    radius = _length("tool-radius", asked.tool_radius, unit)
    return Order(found.design, unit, title, _blank(asked, unit), radius, found.study)


def _blank(asked: argparse.Namespace, unit: str) -> Blank:
    """The blank with the sizes that were typed: lengths in ``unit``, unless they say another."""
    given: dict[str, object] = {}
    for name, declared in quantities_of(Blank()).items():
        if (text := getattr(asked, name)) is not None:
            given[name] = _length(name.replace("_", "-"), text, unit if declared.unit == "mm" else declared.unit)
    given |= {name: value for name in choices_of(Blank()) if (value := getattr(asked, name)) is not None}
    return Blank().replace(**given)


def _length(option: str, text: str, unit: str) -> float:
    """What was typed behind an option, SI."""
    try:
        return typed_number(text, unit) * factor(unit)
    except ValueError as refusal:
        raise ValueError(f"--{option}: {refusal}") from None


def _titles() -> list[str]:
    return [field.name for field in fields(TitleBlock) if field.name != "faults"]


def _options(exports: Sequence[Export]) -> str:
    """How files are asked for."""
    tables = [each.key for each in exports if each in TABLES]
    flags = ", ".join(f"--{each.key}" for each in exports if each not in TABLES)
    return f"{flags}, --table {' '.join(tables)}" if tables else flags


# ---------------------------------------------------------------- optimise


def optimise(asked: argparse.Namespace) -> int:
    """Search for the best design of a study, or for its front, and write the session."""
    session = opened(asked.file).session
    if session is None:
        raise ValueError(f"{asked.file} holds a design; a study, which says what is wanted of it, is needed here")
    study = session.study.around(session.design)
    out = a_new_file(asked.out or Path(asked.file).with_suffix(".found.json"))
    options = {
        name: value for name in ("population", "generations", "seed") if (value := getattr(asked, name)) is not None
    }
    if len(study.minimise) > 1 and asked.method in ("", "nsga2"):
        options = {
            name: session.search[name] for name in ("population", "generations", "seed") if name in session.search
        } | options
    checkpoint = out.with_suffix(".search")
    last = _searched(search(study, asked.method, checkpoint=checkpoint, **options))
    front = surviving(last.front if last.best is None else front_of(study.evaluate(last.best.x), study))
    design = session.design if last.best is None else last.best.design
    text = to_json(replace(session, study=study, design=design, front=front, search={**session.search, **options}))
    write_whole(out, text.encode())
    remove_parts(checkpoint)
    checkpoint.unlink(missing_ok=True)
    print(f"{out}: {len(front)} design{'s' * (len(front) != 1)} of {last.evaluated} evaluated")
    for said in filter(None, (last.message or (last.best.message if last.best else ""), front.message)):
        print(f"  {said}")
    return DONE if len(front) else FAULTY


def _searched(steps: Iterator[Step]) -> Step:
    """The last step of a search, which says on stderr how far it is."""
    told = -EVERY
    for step in steps:
        if time.monotonic() - told >= EVERY:
            told = time.monotonic()
            left = f", {step.seconds_left:.0f} s left" if step.seconds_left == step.seconds_left else ""
            print(f"{step.number} of {step.of or '?'}{left}", file=sys.stderr)
    return step


# ---------------------------------------------------------------- schema


def schema(asked: argparse.Namespace) -> int:
    """Print the JSON Schema of all files that camkit saves."""
    print(schema_text(), end="")
    return DONE


# ---------------------------------------------------------------- course


def course(asked: argparse.Namespace) -> int:
    """Write editions of lessons: for learners, for instructors, on paper, and for programs that grade."""
    for path in write_editions(asked.lessons, asked.out, *asked.edition, learner=asked.learner):
        print(path)
    return DONE


# ---------------------------------------------------------------- the command


def parser() -> argparse.ArgumentParser:
    """What can be asked for."""
    plain = argparse.RawDescriptionHelpFormatter
    top = argparse.ArgumentParser(
        "camkit", description="Mechanism design by files.", epilog=EXAMPLES, formatter_class=plain
    )
    top.add_argument("--version", action="version", version=f"camkit {version('camkit')}")
    each = top.add_subparsers(required=True, metavar="command")
    for act in (lab, app, check, export, optimise, course, schema):
        about = (act.__doc__ or "").strip()
        more = f"{KINDS}{EXAMPLES}" if act is export else EXAMPLES
        one = each.add_parser(act.__name__, help=about, description=about, epilog=more, formatter_class=plain)
        if act in (check, export, optimise):
            one.add_argument("file", help="a JSON file that camkit saved: a design, a study, a front or a decision")
        one.set_defaults(act=act)
        asks = {lab: ask_where, app: ask_where, export: _ask_export, optimise: _ask_optimise, course: _ask_course}
        asks.get(act, lambda _: None)(one)
    return top


def _ask_export(one: argparse.ArgumentParser) -> None:
    _ask_files(one.add_argument_group("which files"))
    one.add_argument("--out", default=".", help="the folder (default: this one)")
    one.add_argument("--unit", default="mm", help="mm or in")
    one.add_argument("--tool-radius", default="5mm", metavar="SIZE", help="of cutter or grinding wheel (default: 5mm)")
    one.add_argument("--insist", action="store_true", help="write a faulty design nevertheless, marked on every sheet")
    said, blank = one.add_argument_group("what the sheets say"), one.add_argument_group("what the cam is cut from")
    for name in _titles():
        said.add_argument(f"--{name}", default="", metavar="TEXT", help=f"{name} in the title block")
    for name, declared in quantities_of(Blank()).items():
        meaning = f"{words(name)}: {declared.meaning} (default: {declared.default:g}{declared.unit})"
        blank.add_argument(f"--{name.replace('_', '-')}", dest=name, metavar="SIZE", help=meaning)
    for name, choice in choices_of(Blank()).items():
        blank.add_argument(f"--{name}", dest=name, metavar="NAME", help=f"{choice.meaning}: {', '.join(choice.named)}")


def _ask_files(group: argparse._ArgumentGroup) -> None:
    group.add_argument("--all", action="store_true", help="every file that can be made")
    group.add_argument(
        "--zip", action="store_true", help="all of them in one zip, with a text that says what each is for"
    )
    for each in EXPORTS:
        if each not in TABLES:
            told = f"{each.words}: {each.use}"
            group.add_argument(f"--{each.key}", action="append_const", dest="files", const=each.key, help=told)
    group.add_argument(
        "--table",
        nargs="+",
        action="extend",
        default=[],
        choices=[each.key for each in TABLES],
        metavar="KIND",
        help="one or more of the kinds below",
    )
    group.set_defaults(files=[])


def _ask_optimise(one: argparse.ArgumentParser) -> None:
    one.add_argument("--method", default="", help=f"one of {', '.join(METHODS)}")
    for name, meaning in (
        ("seed", "the same gives the same again"),
        ("generations", "how many"),
        ("population", "designs in each"),
    ):
        one.add_argument(f"--{name}", type=int, help=meaning)
    one.add_argument("--out", help="the file to write (default: beside the study, .found.json)")


def _ask_course(one: argparse.ArgumentParser) -> None:
    one.add_argument("lessons", help="a folder of lessons, such as notebooks/course, or one of its notebooks")
    one.add_argument("--out", default="editions", help="the folder (default: editions), with one for each edition")
    one.add_argument(
        "--edition", nargs="+", default=[], metavar="EDITION", help=f"of {', '.join((*EDITIONS, WORKSHEET))}"
    )
    one.add_argument("--learner", default=WORKSHEET, metavar="NAME", help="whose numbers are on the worksheet")


def main(arguments: Sequence[str] | None = None) -> int:
    """Do what is asked for; the exit code.

    >>> main(["check", "no such file.json"])
    2
    """
    try:
        asked, unknown = parser().parse_known_args(arguments)
        if unknown and asked.act not in (lab, app):
            parser().error(f"unrecognized arguments: {' '.join(unknown)}")
        asked.options = unknown
    except SystemExit as ended:  # after --help, or a sentence of argparse
        return ended.code if isinstance(ended.code, int) else UNREADABLE
    try:
        code: int = asked.act(asked)
        return code
    except KeyboardInterrupt:
        print("stopped; the same command goes on from where it was", file=sys.stderr)
        return STOPPED
    except (ValueError, ArithmeticError, ModuleNotFoundError, OSError) as refusal:
        print(f"camkit: {_sentence(refusal)}", file=sys.stderr)
        return UNREADABLE


def _sentence(refusal: Exception) -> str:
    """What is wrong; of a file that the system does not give, its name and why."""
    with suppress(AttributeError):
        if refusal.filename:  # type: ignore[attr-defined]
            return f"{refusal.filename}: {refusal.strerror}"  # type: ignore[attr-defined]
    return str(refusal)


if __name__ == "__main__":
    sys.exit(main())
