"""Searches beside each other: what was measured with thirty seeds, and of fronts design by design."""

from statistics import median

from camkit.data import load
from camkit.papers import measured_trials

from .tables import best, table

NEAR = 0.001
"""How near to the optimum a run has to come, as a share of it."""


def one_objective() -> str:
    """Evaluations for each success, on every problem whose optimum is known."""
    problems = list(load("optimiser_comparison")["problems"])
    trials = {problem: measured_trials(problem) for problem in problems}
    methods = [trial.method for trial in trials[problems[0]]]
    columns = [best([trial.expected(NEAR) for trial in trials[problem]], 3) for problem in problems]
    arrived = [sum(trials[p][k].successes(NEAR) for p in problems) for k in range(len(methods))]
    runs = sum(len(trials[p][0].to(NEAR)) for p in problems)
    shares = best([100 * count / runs for count in arrived], 3, least=False)
    return table(("method", *problems, "runs that arrived, %"), zip(methods, *columns, shares, strict=True))


def fronts() -> str:
    """How many designs each way to a front looks at until it has so much of the best hypervolume."""
    data = load("live_front_searches")
    shares = (0.9, 0.95, 0.98, 0.99)
    rows = []
    for name, run in data["searches"].items():
        reached = list(zip(run["designs"], run["hypervolume"], strict=True))
        first = [next((n for n, volume in reached if volume >= share * data["best"]), "never") for share in shares]
        rows.append((name, *first, f"{100 * max(run['hypervolume']) / data['best']:.2f}"))
    head = ("search", *(f"{100 * share:g} %" for share in shares), "at the end, %")
    return table(head, rows)


def longer() -> str:
    """How much longer the genetic search takes."""
    data = load("live_front_searches")
    designs = median(max(run["designs"]) for run in data["searches"].values())
    return (
        f"On {len(data['free'])} free quantities `nsga2` with {data['population']} designs and {data['generations']} "
        f"generations takes {data['times_longer']:g} times the processor time of `quick_front` (median of all runs: "
        f"{designs:g} designs). Measured by `{data['rebuild']}`."
    )
