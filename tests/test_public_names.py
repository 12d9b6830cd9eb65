"""Every public name, panels and pictures too, by every argument: it works, or refuses a wrong kind in a sentence.

The names are found: what ``camkit`` lists, what a notebook imports, and all that the modules in `WINGS` have.  A new
one is called with its defaults and with what `GOOD` has for an argument of its name.
"""

import ast
import inspect
import json
from functools import cache, partial
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
from test_kinds import BAD, CLASSES, FUNCTIONS, NOT_MADE_BY_HAND, outcome

import camkit
from camkit import Judgements, Measure, PeakMeasure, Study, TranslatingRollerCam, deg, explore
from camkit.dynamics import ElasticTrain, HelicalSpring, Part, polydyne
from camkit.linkage import Box
from camkit.machines.shaft import standard_tubes
from camkit.papers.optimiser_trials import measured_trials
from camkit.render.still import draw, layout
from camkit.search.front import front_of
from camkit.search.nsga2 import nsga2_steps
from camkit.study import AnalysisCurve
from camkit.views import pressure_angle
from camkit.views.beside import Beside

NOTEBOOKS = sorted((Path(__file__).parents[1] / "notebooks").glob("**/[0-9]*.ipynb"))
WINGS = [
    "motion",
    "cam",
    "linkage",
    "dynamics",
    "machines",
    "panels",
    "study",
    "search",
    "search.competitive",
    "search.cycle_time",
    "decision",
    "search.front",
    "search.nsga2",
    "study.design_map",
    "render.still",
    "search.polish",
    "machines.shaft",
    "study.sweep",
    "study.tolerances",
    "search.toolbox_genetic",
    "search.epsilon_constraint",
    "papers.optimiser_trials",
]
RESULTS = NOT_MADE_BY_HAND | {
    *("Evaluation", "Step", "IntervalStep", "JudgementRange", "Minimum", "WinnerMap", "Indices"),
    *("Line", "SideBySide", "ShaftAnalysis", "TubeSizes", "Trials", "Picture", "Still", "OnGrid", "Material"),
    *("Evaluated", "Found", "Active", "Row", "Price", "Response", "SpeedSweep"),
    *("Event", "Flight", "Windup", "Reduced", "CamsOverSpeed", "Conversion"),
    *("BearingLife", "Entrainment", "SurfaceLife"),
    *("FactorCheck", "FactorRow"),
} - {"Front"}  # fmt: skip
"""What functions give, and nobody makes."""
INSIDE = {
    "small_png",
    "below",
    "figure_of",
    "strip",
    "layout",
    "draw",
    "positions_of",
    "on_grid",
    "turn_range",
    "given_to",
    "made_by",
    "saved",
}
"""How a picture is put together, and a search."""
RUBBISH = {
    name: BAD[name]
    for name in (
        *("nan", "-1", "2.5", "1e160", "10**400", "True", "None", "text", "no list", "list"),
        *("tuple of text", "mapping", "object", "class", "function", "shape (2, 3)", "array of objects"),
        *("array of text",),
        *("masked", "matrix", "list in itself", "lists in lists", "class of designs", "population", "study"),
    )
}  # fmt: skip


def _imported():
    """Where a notebook imports a name from, and the name."""
    for notebook in NOTEBOOKS:
        for cell in json.loads(notebook.read_text(encoding="utf-8"))["cells"]:
            if cell["cell_type"] == "code":
                for node in ast.walk(ast.parse("".join(cell["source"]))):
                    if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("camkit"):
                        yield from ((node.module, alias.name) for alias in node.names)


def _public():
    """Every public callable by its name."""
    found = {("camkit", name) for name in camkit.__all__} | set(_imported())
    for module in (import_module(f"camkit.{wing}") for wing in WINGS):
        own = getattr(module, "__all__", None) or [
            name for name, thing in vars(module).items() if getattr(thing, "__module__", "") == module.__name__
        ]
        found |= {(module.__name__, name) for name in own if name[0] != "_"}
    every = ((getattr(import_module(module), name, None), name) for module, name in sorted(found))
    things = {thing: name for thing, name in every if callable(thing) and not inspect.isabstract(thing)}
    tested = {thing.__qualname__ for thing in (*CLASSES, *FUNCTIONS)}
    return {
        f"{thing.__module__.removeprefix('camkit.')}.{name}": thing
        for thing, name in things.items()
        if getattr(thing, "__qualname__", None) not in tested and _arguments(thing) and not _made_or_inside(name)
    }


def _made_or_inside(name):
    return name in RESULTS | INSIDE or name.endswith("Analysis")


def _arguments(thing):
    """The arguments of a function that can be refused; of a view what it shows, the rest being the picture's."""
    try:
        parameters = inspect.signature(thing).parameters.values()
    except ValueError:  # of a class of exceptions
        return {}
    own = {p.name: p for p in parameters if p.kind is not p.VAR_KEYWORD}
    return dict(list(own.items())[:1]) if _is_view(thing) else own


def _is_view(thing):
    """Whether it makes a picture of what it is given first."""
    signature = inspect.signature(thing)
    return thing.__module__.startswith(("camkit.views.", "camkit.papers.")) and signature.return_annotation == "Picture"


CAM = TranslatingRollerCam()
height = Measure("height", "mm", lambda analysis: analysis.pitch_radius.max(-1))
slope = PeakMeasure("slope", "deg", lambda analysis: abs(analysis.pressure_angle), angle=lambda a: a.cam_angle)
STUDY = Study(CAM, ["base_radius"], [height], at_most={slope: 60 * deg}, angles=31)
TWO = STUDY.replace(minimise=(height, slope), at_most={})
FRONT = front_of(TWO.evaluate([[0.03], [0.04], [0.05]]), TWO)
BOX = Box((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
SPACE = {"base_radius": (0.02, 0.05)}
LEVER = partial(camkit.machines.cam_lever_study, free_laws=False, angles=31)
SHAFT = camkit.shaft_study()
TUBES = standard_tubes()
TRIALS = measured_trials("tension spring")


OVER_TWO = STUDY.replace(free={**SPACE, "roller_radius": (0.005, 0.01)})
"""One objective over two quantities."""


@cache
def app(name="roller"):
    """An explorer."""
    kind = {"roller": TranslatingRollerCam, "lever": camkit.machines.CamLever}[name]
    return explore(kind(), pressure_angle, free=["roller_radius"])


@cache
def search():
    """A panel with a front, which nobody has searched yet."""
    return camkit.pareto_panel(app(), TWO)


@cache
def generation():
    """The first step of a search."""
    return next(nsga2_steps(TWO, 4, 1, 1))


GOOD = {
    "acceleration": lambda: [0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0],
    "angle": lambda: [0.0, 0.2, 0.4, 0.8, 1.2, 1.4, 1.6],
    "analyses": lambda: {"one": CAM.analyse(31)},
    "analysis": lambda: CAM.analyse(31),
    "at_least": dict,
    "at_most": lambda: {height: 0.06},
    "best": lambda: 0.5,
    "box": lambda: BOX,
    "joint": lambda: "crank",
    "cam": camkit.ValveCam,
    "cam_angle": lambda: np.linspace(0, 2 * np.pi, 31),
    "columns": lambda: {"angle": [0.0, 1.0]},
    "count": lambda: 3,
    "curvature": lambda: 50.0,
    "curve": lambda: AnalysisCurve("pressure_angle", "deg", "pressure angle"),
    "declared": lambda: camkit.quantities.declarations(CAM)["base_radius"],
    "design": lambda: CAM,
    "done": lambda: 0.5,
    "draw": lambda: 0.5,
    "explorer": app,
    "f": lambda: [[0.0, 1.0], [1.0, 0.0]],
    "first": lambda: TRIALS[0],
    "force_per_length": lambda: 1e5,
    "free": lambda: ("base_radius",),
    "found": lambda: [camkit.minimise(LEVER())],
    "frequency": lambda: 20.0,
    "front": lambda: FRONT,
    "fronts": lambda: {"one": FRONT},
    "generations": lambda: 1,
    "half_widths": lambda: {"base_radius": 0.0002},
    "head": lambda: ("law", "Cv"),
    "judgements": lambda: Judgements(("a", "b"), [3]),
    "k": lambda: 2,
    "laws": lambda: (camkit.Cycloidal(),),
    "limit": lambda: 1e6,
    "of": lambda: STUDY,
    "diameters": lambda: [0.02, 0.04],
    "inner": lambda: "inner_diameter",
    "lengths": lambda: [0.02, 0.04],
    "lift": lambda: 10.0,
    "outer": lambda: "outer_diameter",
    "longest": lambda: 1.0,
    "lubricant": camkit.cam.Lubricant,
    "matrices": lambda: [[1, 3], [1 / 3, 1]],
    "modulus": lambda: 1e11,
    "most": lambda: 100.0,
    "names": lambda: ("a", "b"),
    "pair": camkit.cam.ContactPair,
    "panel": app,
    "peak": lambda: slope,
    "plane": lambda: camkit.DesignMap(SHAFT, n=5),
    "population": lambda: 4,
    "pressure": lambda: 1e9,
    "problem": lambda: "tension spring",
    "program": lambda: CAM.motion,
    "room": lambda: 8.0,
    "rows": lambda: [("cycloidal", 2.0)],
    "searches": lambda: {"one": [(0.1, 0.2), (0.2, 0.1)]},
    "second": lambda: TRIALS[1],
    "seed": lambda: 1,
    "series": lambda: "EN 10210-2",
    "shaft": camkit.UniversalJointShaft,
    "shape": lambda: 3.0,
    "share": lambda: 0.5,
    "shares": lambda: [0.1],
    "shortest": lambda: 0.9,
    "source": search,
    "speed": lambda: 10.0,
    "space": lambda: SPACE,
    "steps": lambda: 2,
    "sweep": lambda: camkit.study.Sweep(STUDY, n=3),
    "studies": lambda: {"two": TWO},
    "study": lambda: TWO,
    "target": lambda: 0.01,
    "min_over_bound.name": lambda: "base_radius",
    "designs_on_plane.designs": lambda: {"a tube": camkit.UniversalJointShaft()},
    "tolerances": lambda: camkit.Tolerances(STUDY, {"base_radius": 0.001}, parts=64),
    "torque": lambda: np.ones(31),
    "mass": lambda: 0.1,
    "parts": lambda: [Part("rod", 0.1, 1e6)],
    "ElasticFollower.cam": lambda: CAM,
    "CamWithPins.cam": lambda: CAM,
    "PolydyneProgram.segments": lambda: CAM.motion.segments,
    **{
        f"{of}_between.{end}": lambda: 60.0
        for of in ("dwell_vibration", "peak_force", "min_force")
        for end in ("low", "high")
    },
    "beside_plain.analysis": lambda: CAM.replace(motion=polydyne(CAM.motion, ElasticTrain(), CAM.load, 10.0)).analyse(),
    "polydyne.motion": lambda: CAM.motion,
    "polydyne.load": lambda: CAM.load,
    "train": ElasticTrain,
    "speeds": lambda: [20.0, 30.0],
    "tuned.period_ratio": lambda: 5.0,
    "factor_check.machine": lambda: camkit.dynamics.ElasticFollower(CAM),
    "trials": lambda: TRIALS[:2],
    "tubes": lambda: TUBES,
    "unit": lambda: "mm",
    "value": lambda: 0.03,
    "velocity": lambda: 2.0,
    "views": lambda: (pressure_angle,),
    "weights": lambda: None,
    "words": lambda: "1/3",
    "methods": lambda: ("slsqp",),
    "path": lambda: "a design.json",
    "shown": lambda: CAM,
    "start": lambda: None,
    "thing": lambda: CAM,
    "ways": lambda: {"nsga2": (TWO, partial(nsga2_steps, population=4, generations=1, seed=1))},
    "window": lambda: [[0.12, 0.09], [0.14, 0.11]],
    "worst": lambda: (0.1, 2.0),
    # where an argument of the same name is something else
    "Range.low": lambda: 10.0,
    "Range.high": lambda: 20.0,
    "Range.step": lambda: 1.0,
    "changes.before": lambda: 1.0,
    "changes.after": lambda: 2.0,
    "exercise.name": lambda: "a size",
    "exercise.question": lambda: "How large is it?",
    "exercise.answer": lambda: lambda numbers: 1.0,
    "cam_life.strength": camkit.cam.SurfaceStrength,
    "value_of.path": lambda: "base_radius",
    "write_table.path": lambda: "a table.csv",
    "write_dxf.path": lambda: "a cam.dxf",
    "write_gcode.path": lambda: "a cam.ngc",
    "to_workshop.path": lambda: "a cam.zip",
    "with_quantities.values": lambda: {"base_radius": 0.04},
    "AnalysisCurve.name": lambda: "pressure_angle",
    "AnalysisCurve.label": lambda: "pressure angle",
    "CycleTimePanel.explorer": lambda: app("lever"),
    "CycleTimePanel.studies": lambda: LEVER(),
    "Front.f": lambda: FRONT.f,
    "Front.x": lambda: FRONT.x,
    "ContourPanel.studies": lambda: {"one": OVER_TWO},
    "ContourPanel.weights": lambda: {"height": 1.0},
    "FrontsPanel.ways": lambda: {"nsga2": (TWO, partial(nsga2_steps, population=4, generations=1, seed=1))},
    "data.load.name": lambda: "door_handle",
    "optimise_panel.explorer": app,
    "cycle_time_panel.explorer": lambda: app("lever"),
    "cycle_time_panel.studies": lambda: LEVER(),
    "shortest_interval.study": lambda: LEVER(),
    "goal_seek.study": lambda: STUDY,
    "cycle_time_steps.study": lambda: LEVER(),
    "contour_panel.studies": lambda: {"one": OVER_TWO},
    "OptimisePanel.studies": lambda: STUDY,
    "optimise_panel.studies": lambda: STUDY,
    "contour_panel.weights": lambda: {"height": 1.0},
    "group.judgements": lambda: {"Anna": [3, 5, 2], "Ben": [1, 4, 1]},
    "compare_fronts.ways": lambda: {"nsga2": (TWO, partial(nsga2_steps, population=4, generations=1, seed=1))},
    "TolerancePanel.study": lambda: STUDY,
    "Part.name": lambda: "rod",
    "Decision.chosen": lambda: 0,
    "Session.search": dict,
    "Session.judgements": dict,
    "lightest_tube.study": lambda: camkit.shaft_study(space={name: (0.05, 0.2) for name in SHAFT.free}),
    "crossed.first": lambda: 0.0,
    "crossed.second": lambda: 10.0,
    "convergence.generations": lambda: [generation()],
    "cams_beside.shown": lambda: Beside({"one": camkit.HighSpeedCam().analyse()}, slope),
    "curves_beside.shown": lambda: Beside({"one": CAM.analyse(31)}, slope),
    "motion_in.make": lambda: lambda: CAM.motion,
    "cam_card.motion": lambda: CAM.motion,
    "cam_card.lift": lambda: 0.001,
    "at_lift.what": lambda: "duration",
    "at_lift.lift": lambda: 0.001,
    "flywheel.fluctuation": lambda: 0.02,
    "spring_duty.spring": HelicalSpring,
    "spring_duty.preload": lambda: 100.0,
    "spring_duty.travel": lambda: 0.01,
    "near_surge.spring": HelicalSpring,
    "return_springs.coils": lambda: [0.02, 0.03],
    "return_springs.active_coils": lambda: [5.0],
    "fitted.cam": lambda: CAM,
    "fitted.spring": HelicalSpring,
    "fitted.preload": lambda: 100.0,
    "cam_from_outline.points": lambda: camkit.cam.DrawnOutline.circle(0.04, 0.0, -0.015),
    "cam_from_outline.follower": lambda: CAM,
    "deviation_from.motion": lambda: CAM.motion,
    "laid_over.outline": lambda: camkit.cam.DrawnOutline.circle(0.04, 0.0, -0.015),
    "deviation_over.outline": lambda: camkit.cam.DrawnOutline.circle(0.04, 0.0, -0.015),
    "motion_from_outline.points": lambda: camkit.cam.DrawnOutline.circle(0.04, 0.0, -0.015),
    "motion_from_outline.follower": lambda: CAM,
    "motion_from_table.angle": lambda: np.linspace(0.0, 2.0, 9),
    "motion_from_table.level": lambda: np.linspace(0.0, 2.0, 9) ** 2,
    "read_outline.path": lambda: "\n".join(
        f"{np.cos(t) * 40} {np.sin(t) * 40 - 9}" for t in np.linspace(0, 6.2, 60)
    ).encode(),
    "read_motion.path": lambda: b"0;1\n60;3\n120;4\n180;3\n240;2\n300;2\n",
    "departure.target": lambda: 0.5,
    "failures.study": lambda: STUDY.under({"base_radius": 0.001}),
    "failures.x": lambda: STUDY.x0,
}
"""Right values by the name of an argument, or of a function and its argument."""


def good(name, parameter):
    """What is right for an argument."""
    for key in (f"{name}.{parameter.name}", f"{name.rpartition('.')[2]}.{parameter.name}", parameter.name):
        if key in GOOD and (parameter.default is parameter.empty or "." in key):
            return GOOD[key]()
    assert parameter.default is not parameter.empty, f"GOOD says nothing of {name}.{parameter.name}"
    return parameter.default


@cache
def axes(view):
    """Where a picture draws what a view shows; nothing is drawn there of what is refused."""
    return layout([view], 3, 2)[1]


def call(thing, given):
    """``thing(**given)``, a view as a picture draws it, a generator to its first step."""
    parameters = inspect.signature(thing).parameters
    if _is_view(thing):
        return draw(*given.values(), axes(thing), [thing])
    gathered = [name for name, p in parameters.items() if p.kind is p.VAR_POSITIONAL]
    before = [name for name in given if gathered and name in list(parameters)[: list(parameters).index(gathered[0])]]
    named = {name: value for name, value in given.items() if name not in (*before, *gathered)}
    made = thing(*(given[name] for name in before), *(v for name in gathered for v in given[name]), **named)
    return next(made, None) if inspect.isgenerator(made) else made


PUBLIC = _public()
MADE = {f"{thing.__module__}.{thing.__name__}" for thing in PUBLIC.values() if inspect.isclass(thing)}


def _only_makes_a_panel(thing):
    """A function that hands all that it is given to the class of a panel, which is tried itself."""
    made = f"{thing.__module__}.{inspect.signature(thing).return_annotation}"
    return thing.__module__.startswith("camkit.panels.") and made in MADE


CALLS = [
    (n, argument) for n, thing in PUBLIC.items() if not _only_makes_a_panel(thing) for argument in _arguments(thing)
]


def given(name):
    """Every argument of a public name that is not left to its default."""
    return {n: good(name, p) for n, p in _arguments(PUBLIC[name]).items()}


OTHERS = [name for name, thing in PUBLIC.items() if not _is_view(thing)]
"""All but views, which take what another mechanism does not have; as measures do."""


@pytest.mark.parametrize("name", [name for name in OTHERS if not isinstance(PUBLIC[name], Measure)])
def test_every_argument_is_good_before_one_is_bad(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    camkit.write(CAM, "a design.json")
    call(PUBLIC[name], given(name))


@pytest.mark.parametrize(("name", "argument"), CALLS, ids=map(".".join, CALLS))
def test_a_public_name_works_or_refuses_in_a_sentence(name, argument, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for file in ("a design.json", RUBBISH["text"]):
        camkit.write(CAM, file)
    right, gathers = given(name), _arguments(PUBLIC[name])[argument].kind is inspect.Parameter.VAR_POSITIONAL
    tried = {bad: (value,) if gathers else value for bad, value in RUBBISH.items()}
    failed = {bad: outcome(lambda v=value: call(PUBLIC[name], right | {argument: v})) for bad, value in tried.items()}
    assert {bad: said for bad, said in failed.items() if said} == {}
