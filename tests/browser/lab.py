"""Drives a real JupyterLab in a real Chromium, as a person would: open a notebook, run it, look, press keys.

The server is started with ``window.jupyterapp`` exposed, so that questions such as "is a cell running?"
are asked of JupyterLab itself and not guessed from its looks.
"""

from __future__ import annotations

import ast
import json
import os
import re
import secrets
import shutil
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Locator, Page
from playwright.sync_api import TimeoutError as PlaywrightTimeout

from camkit.quantities import quantities_of, value_of

_SHOWN = """() => { const { pictures, measures, sentence, values } = camkit.shown();
    const plain = (v) => (typeof v === "number" ? [String(v)] : typeof v === "object" && v ? Array.from(v, String) : v);
    const mark = (m) => Object.fromEntries(Object.entries(m).map(([name, v]) => [name, plain(v)]));
    return JSON.stringify({ sentence, values: [...values], measures: measures.map((m) => m.text),
                            pictures: pictures.map((p) => ({ ...p, marks: p.marks.map(mark) })) }); }"""
CHROMIUM_FLAGS = [
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-gpu",
    "--disable-quic",
    "--disable-sync",
    "--headless",
    "--no-first-run",
    "--no-sandbox",
]

POLLING = 100
"""Milliseconds between two looks at what takes long: at every frame, the page would draw frames for it alone."""

# What `make lab` and `make app` give their servers.
SETTINGS = Path(__file__).parents[2] / ".jupyter"


def find_chromium() -> str | None:
    """The browser that ``CAMKIT_CHROMIUM`` names, or the first one installed."""
    names = ("chromium", "chromium-browser", "google-chrome")
    return os.environ.get("CAMKIT_CHROMIUM") or next(filter(None, map(shutil.which, names)), None)


def copy_notebooks(source: Path, target: Path) -> None:
    """The notebooks for a server of tests."""
    shutil.copytree(source, target, ignore=shutil.ignore_patterns(".*"))


@dataclass(frozen=True)
class LabServer:
    """A running JupyterLab; ``root`` is the folder whose notebooks it serves."""

    url: str
    token: str
    root: Path

    def api(self, path: str, method: str = "GET") -> Any:
        """The answer of the server's REST interface."""
        headers = {"Authorization": f"token {self.token}"}
        request = urllib.request.Request(f"{self.url}/api/{path}", method=method, headers=headers)
        with urllib.request.urlopen(request, timeout=10) as answer:
            return json.loads(answer.read() or "null")

    def end_kernels(self) -> None:
        """Ends what the last test left running."""
        for kernel in self.api("kernels"):
            self.api(f"kernels/{kernel['id']}", "DELETE")


@contextmanager
def lab_server(folder: Path, root: Path, source: Path, timeout: float = 120) -> Iterator[LabServer]:
    """JupyterLab on a free port, serving ``root``; its kernels import from ``source`` first.

    Its settings are those of `make lab`; none of the user's count.
    """
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    server = LabServer(f"http://127.0.0.1:{port}", secrets.token_hex(16), root)
    environment = os.environ | isolation(folder) | {"PYTHONPATH": str(source), "JUPYTER_CONFIG_PATH": str(SETTINGS)}
    configuration = {
        "ServerApp": {
            "port": port,
            "port_retries": 0,
            "root_dir": str(root),
            "allow_root": True,
            "open_browser": False,
        },
        "IdentityProvider": {"token": server.token},
        "LabApp": {"expose_app_in_browser": True, "extension_manager": "readonly"},
    }
    config = Path(environment["JUPYTER_CONFIG_DIR"], "jupyter_lab_config.json")
    config.parent.mkdir()
    config.write_text(json.dumps(configuration), encoding="utf-8")
    log = folder / "server.log"
    with log.open("w") as out:
        process = subprocess.Popen(
            [sys.executable, "-m", "jupyterlab"],
            cwd=root,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=subprocess.STDOUT,
        )
        try:
            _wait_for(server, process, log, timeout)
            yield server
            server.end_kernels()
        finally:
            process.terminate()
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


@contextmanager
def voila_server(folder: Path, source: Path, *options: str) -> Iterator[str]:
    """Voilà as `make app` starts it, over ``folder / "notebooks"``; its address.  It writes to ``server.log``."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    published = ("--Voila.ip=127.0.0.1", "--Voila.config_file_paths=notebooks", "--no-browser", f"--port={port}")
    command = [sys.executable, "-m", "voila", "notebooks", *published, *options]
    environment = os.environ | isolation(folder) | {"PYTHONPATH": str(source), "OPENBLAS_NUM_THREADS": "1"}
    environment["JUPYTER_PATH"] = str(SETTINGS)
    with (folder / "server.log").open("w") as log:
        process = subprocess.Popen(command, cwd=folder, env=environment, stdout=log, stderr=subprocess.STDOUT)
    address = f"http://127.0.0.1:{port}"
    try:
        eventually(lambda: process.poll() is not None or _answers(address), seconds=60)
        assert process.poll() is None, (folder / "server.log").read_text()
        yield address
    finally:
        process.terminate()
        process.wait(30)


def _answers(address: str) -> bool:
    try:
        return bool(urllib.request.urlopen(address, timeout=5).status == 200)
    except (urllib.error.URLError, ConnectionError, TimeoutError):
        return False


def isolation(folder: Path) -> dict[str, str]:
    """The environment in which the user's own settings and kernels do not count."""
    homes = {
        "IPYTHONDIR": "ipython",
        "JUPYTER_CONFIG_DIR": "config",
        "JUPYTER_DATA_DIR": "data",
        "JUPYTER_RUNTIME_DIR": "runtime",
        "JUPYTERLAB_SETTINGS_DIR": "settings",
        "JUPYTERLAB_WORKSPACES_DIR": "workspaces",
    }
    # The kernel "python3" is then the one beside this Python.
    return {name: str(folder / home) for name, home in homes.items()} | {"JUPYTER_PREFER_ENV_PATH": "1"}


def _wait_for(server: LabServer, process: subprocess.Popen[bytes], log: Path, timeout: float) -> None:
    end = time.monotonic() + timeout
    while time.monotonic() < end and process.poll() is None:
        try:
            server.api("status")
            return
        except (urllib.error.URLError, ConnectionError, TimeoutError):
            time.sleep(0.1)
    raise RuntimeError(
        f"JupyterLab did not start within {timeout:g} s. The end of its log:\n{log.read_text(encoding='utf-8')[-3000:]}"
    )


# What JupyterLab says of the notebook in front: its kernel, and each cell with the error it ended in, if any.
_STATE = """() => {
    const panel = window.jupyterapp.shell.currentWidget;
    const error = (cell) => (cell.model.outputs?.toJSON() ?? []).find(output => output.output_type === 'error');
    return {
        kernel: panel.sessionContext.session?.kernel?.status ?? 'none',
        cells: panel.content.widgets.map(cell => ({
            source: cell.model.sharedModel.getSource(),
            running: cell.model.executionState === 'running',
            error: error(cell) ?? null,
        })),
    };
}"""

_READY = """(name) => {
    const panel = window.jupyterapp?.shell.currentWidget;
    return panel?.context?.path === name && panel.context.isReady && panel.sessionContext.isReady
        && panel.sessionContext.session?.kernel?.status === 'idle' && panel.content.widgets.length > 0;
}"""

_RUN = """() => {
    window.camkitRan = false;
    window.jupyterapp.commands.execute('notebook:run-all-cells').finally(() => { window.camkitRan = true; });
}"""

_RAN = "() => window.camkitRan && window.jupyterapp.shell.currentWidget.sessionContext.session.kernel.status === 'idle'"

_ASK = """async ([expression, seconds]) => {
    const kernel = window.jupyterapp.shell.currentWidget.sessionContext.session.kernel;
    const asked = kernel.requestExecute(
        {code: '', silent: true, store_history: false, user_expressions: {answer: expression}});
    const late = new Promise(resolve => setTimeout(() => resolve(null), 1000 * seconds));
    const reply = await Promise.race([asked.done, late]);
    return reply && reply.content.user_expressions.answer;
}"""


_CLOSE = "() => { for (const widget of [...(window.jupyterapp?.shell.widgets('main') ?? [])]) widget.dispose(); }"
_OPEN = f"""async (name) => {{
    ({_CLOSE})();
    const {{ commands, shell }} = window.jupyterapp;
    const panel = await commands.execute("docmanager:open", {{ path: name }});
    for (const other of [...shell.widgets('main')]) if (other !== panel) other.dispose(); // a launcher
}}"""


def open_notebook(page: Page, name: str, timeout: float = 60) -> None:
    """Opens a notebook of the server's folder, alone, and waits until its kernel is idle."""
    if page.evaluate("() => Boolean(window.jupyterapp)"):
        page.evaluate(_OPEN, name)
        _wait_until_ready(page, name, timeout)
    else:
        load_notebook(page, name, timeout)


def load_notebook(page: Page, name: str, timeout: float = 60) -> None:
    """Loads JupyterLab, again if it is there, with a notebook in an empty workspace."""
    page.goto(f"/lab/tree/{name}?reset")
    _wait_until_ready(page, name, timeout)


def _wait_until_ready(page: Page, name: str, timeout: float) -> None:
    try:
        page.wait_for_function(_READY, arg=name, timeout=1000 * timeout, polling=POLLING)
    except PlaywrightTimeout:
        raise AssertionError(f"{name} was not open with an idle kernel after {timeout:g} s{_dialog(page)}") from None


def close_all(page: Page) -> None:
    """Closes all notebooks of the window as they are; JupyterLab stays."""
    page.evaluate(_CLOSE)


_NO_PICTURES = "setattr(__import__('camkit.panels.kit.displayed', fromlist=['REST']), 'REST', 3600)"
"""A kernel draws the pictures that are stored when it has rested for so long: nobody waits for them here."""


def run_all(page: Page, timeout: float = 120, pictures: bool = False) -> None:
    """Runs all cells and waits until the kernel is idle; a cell that ends in an error fails the test.

    The pictures that are stored with panels take most of a kernel's time: they are made only if ``pictures`` says so.
    """
    if not pictures:
        kernel_value(page, _NO_PICTURES)
    page.evaluate(_RUN)
    try:
        page.wait_for_function(_RAN, timeout=1000 * timeout, polling=POLLING)
    except PlaywrightTimeout:
        state = page.evaluate(_STATE)
        running = [
            f"cell {i} still runs:\n{cell['source']}" for i, cell in enumerate(state["cells"]) if cell["running"]
        ]
        no_cell = f"no cell runs and the kernel is {state['kernel']}"
        raise AssertionError(f"after {timeout:g} s {running[0] if running else no_cell}{_dialog(page)}") from None
    for i, cell in enumerate(page.evaluate(_STATE)["cells"]):
        if cell["error"]:
            traceback = re.sub(r"\x1b\[[0-9;]*m", "", "\n".join(cell["error"]["traceback"]))
            raise AssertionError(f"cell {i} ended in an error:\n{cell['source']}\n\n{traceback}")


def cell(page: Page, i: int) -> Locator:
    """Cell ``i`` of the notebook in front, counted from 0 with the cells of prose, scrolled into view."""
    page.evaluate("(i) => window.jupyterapp.shell.currentWidget.content.scrollToItem(i)", i)
    return page.locator(".jp-NotebookPanel:not(.lm-mod-hidden) .jp-Notebook .jp-Cell").nth(i)


def cell_output(page: Page, i: int) -> Locator:
    """What cell ``i`` shows below its code."""
    return cell(page, i).locator(".jp-Cell-outputArea")


def kernel_value(page: Page, expression: str, timeout: float = 30) -> Any:
    """What a Python expression is in the notebook's kernel, by way of JSON (an array comes as a list)."""
    as_json = f"__import__('json').dumps({expression}, default=lambda o: o.tolist())"
    answer = page.evaluate(_ASK, [as_json, timeout])
    if answer is None:
        raise AssertionError(f"the kernel did not say within {timeout:g} s what {expression} is")
    if answer["status"] != "ok":
        raise AssertionError(f"{expression}: {answer['ename']}: {answer['evalue']}")
    return json.loads(ast.literal_eval(answer["data"]["text/plain"]))


def in_picture(output: Locator, x: float, y: float, k: int = 0) -> tuple[float, float]:
    """Where a place of picture ``k`` of a sheet, in its user units, is in the window."""
    canvas = output.locator(".camkit-pictures canvas").nth(k)
    canvas.scroll_into_view_if_needed()
    place = """(canvas, [x, y]) => {
        const { parts } = canvas.closest('.camkit-sheet').parentElement.camkit, box = canvas.getBoundingClientRect();
        const chart = [...parts.values()].flatMap(({ part }) => part.charts ?? []).find((c) => c.canvas === canvas);
        return [box.left + chart.x(x), box.top + chart.y(y)];
    }"""
    left, top = canvas.evaluate(place, [x, y])
    return left, top


@dataclass(frozen=True)
class Instrument:
    """An instrument of the notebook in front: its ``name`` in the kernel, and its ``place`` among those of the page."""

    page: Page
    name: str = "app"
    place: int = 0

    @property
    def root(self) -> Locator:
        """The instrument, with every group of its sliders open."""
        root = self.page.locator(".camkit-page").nth(self.place)
        root.evaluate("root => root.querySelectorAll('.camkit-left details').forEach(group => { group.open = true; })")
        return root

    def slider(self, label: str) -> Locator:
        return self.root.get_by_role("slider", name=label, exact=True).first  # those of its tabs come later

    def box(self, label: str) -> Locator:
        return self.root.get_by_label(f"{label}, number", exact=True)

    def type(self, label: str, text: str) -> None:
        self.box(label).fill(text)
        self.box(label).press("Enter")

    def choose(self, option: str) -> None:
        """Takes an option from the menu that has it."""
        self.root.locator(".camkit-left select").filter(has_text=option).first.select_option(label=option)

    def reset(self) -> None:
        self.root.get_by_role("button", name="Reset").click()

    def shown(self) -> Any:
        """What it shows, when nothing is left to be drawn."""
        panel = f"document.querySelectorAll('.camkit-page')[{self.place}].parentElement.camkit"
        told = f"({_SHOWN.replace('camkit.shown', f'{panel}.shown')})()"  # at once: the next frame may show another
        return json.loads(
            self.page.wait_for_function(f"() => {panel}?.outputs && !{panel}.frame && {told}").json_value()
        )

    def shows(self, design: Any, measures: Iterable[Any]) -> None:
        """The page and the kernel come to ``design``; the page has its measures, computed here."""
        wanted = [value_of(design, path) for path in quantities_of(design)]
        eventually(lambda: self.shown()["values"][: len(wanted)] == pytest.approx(wanted, rel=1e-9))
        eventually(lambda: numbers_of(self.shown()) == numbers_in(design, measures))
        known = f"[{self.name}.values, {self.name}.message]"  # the page has let go, and both agree
        eventually(lambda: kernel_value(self.page, known)[0] == pytest.approx(wanted, rel=1e-9))
        assert "The page computes" not in kernel_value(self.page, known)[1]


def shown_by(page: Page, panel: str = "camkit") -> Any:
    """What a page shows, as data: one text, since many small values take long from a browser to Python."""
    return json.loads(page.evaluate(_SHOWN.replace("camkit.shown", f"{panel}.shown")))


def numbers_of(shown: Any) -> list[str]:
    """The numbers of the measures that a page shows, without their units."""
    return [text.replace("°", " °").partition(" ")[0] for text in shown["measures"]]


RAISED = str.maketrans("0123456789-.", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻·", "+")
"""Powers as a page writes them."""


def on_page(text: str) -> str:
    """A number of the package as a page writes it."""
    return re.sub(r"\^([-+]?[\d.]+)", lambda power: power[1].translate(RAISED), text.replace(" deg", " °"))


def numbers_in(design: Any, measures: Iterable[Any]) -> list[str]:
    """The numbers that it has to show."""
    analysis = design.analyse()
    return [m.text(m.one(analysis)).partition(" ")[0] for m in measures]


STORED = """() => window.jupyterapp.shell.currentWidget.content.widgets.filter(({ model }) => model.type === 'code')
    .map(({ model }) => model.outputs.toJSON().map(({ data }) => 'image/png' in data))"""
"""Of each cell's outputs, whether a picture is stored with it."""
OWN_SHEETS = ".camkit-sheet:not(.camkit-page *)"
"""The sheets that are the output of a cell of their own, not those in a tab of an instrument."""

_MARKS = """(root) => {
    const list = (values) => typeof values === 'number' ? [values] : Array.from(values);
    const marks = root.parentElement.camkit.shown().pictures[0].marks.filter((mark) => mark.x !== undefined);
    return Object.fromEntries(marks.map((mark) => [mark.key, [list(mark.x), list(mark.y)]]));
}"""


def marks_of(sheet: Locator) -> dict[str, list[list[float]]]:
    """What a sheet's first picture draws, in user units: x and y of each mark."""
    marks: dict[str, list[list[float]]] = sheet.evaluate(_MARKS)
    return marks


def type_number(page: Page, name: str, text: str) -> None:
    """Type into the box of a quantity of the instrument."""
    box = page.locator(".camkit-page").get_by_label(f"{name}, number", exact=True)
    box.fill(text)
    box.press("Enter")


def eventually(check: Callable[[], bool], seconds: float = 15) -> None:
    """Waits until ``check()`` holds."""
    end = time.monotonic() + seconds
    while not check():
        assert time.monotonic() < end, f"did not come true within {seconds:g} s"
        time.sleep(0.05)


def screenshot(page: Page, path: Path | str) -> None:
    """Saves what the window shows, to be looked at."""
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    page.screenshot(path=path)


def _dialog(page: Page) -> str:
    """The text of a dialog that is in the way, if there is one."""
    texts = page.locator(".jp-Dialog-content").all_inner_texts()
    return f"; a dialog is open: {texts[0]}" if texts else ""
