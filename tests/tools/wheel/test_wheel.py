"""The wheel in an environment that holds nothing else: JupyterLab opens the notebooks, and Colab's cell runs."""

import json
import os
import re
import socket
import subprocess
import sys
import sysconfig
import time
from pathlib import Path
from urllib.error import URLError
from urllib.request import urlopen

import pytest

REPOSITORY = Path(__file__).parents[3]
RUN = """
import json, sys
import nbformat
from nbclient import NotebookClient
notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(sys.stdin.read())])
NotebookClient(notebook, timeout=300).execute()
print(json.dumps([out for cell in notebook.cells for out in cell.outputs]))
"""


def ended(*arguments: str | Path, **options) -> str:
    done = subprocess.run([*map(str, arguments)], capture_output=True, text=True, encoding="utf-8", **options)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="module")
def scripts(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where the programs of an environment are that was made of the wheel, with the extra `lab`."""
    folder = tmp_path_factory.mktemp("made")
    ended(sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", folder, REPOSITORY)
    wheel = next(folder.glob("camkit-*.whl"))
    began = time.monotonic()
    ended(sys.executable, "-m", "venv", folder / "env")
    programs = Path(sysconfig.get_path("scripts", "venv", {"base": str(folder / "env")}))
    pinned = ("-c", REPOSITORY / "constraints.txt", f"camkit[lab] @ {wheel.as_uri()}")
    ended(programs / "python", "-m", "pip", "install", "--quiet", "--disable-pip-version-check", *pinned)
    print(f"\nan environment of the wheel with the extra lab: {time.monotonic() - began:.1f} s")
    return programs


def alone() -> dict[str, str]:
    """The environment without what a developer has set."""
    return {name: value for name, value in os.environ.items() if not re.match("PYTHON|COV|JUPYTER|CAMKIT", name)}


def answer(address: str, server: subprocess.Popen[bytes]) -> str:
    """What the server says, as soon as it answers."""
    for _ in range(600):
        assert server.poll() is None
        try:
            return urlopen(address).read().decode("utf-8")
        except (URLError, ConnectionError):
            time.sleep(0.2)
    raise AssertionError(f"nobody answers at {address}")


def test_lab_opens_the_notebooks_of_the_wheel_with_our_settings(scripts: Path, tmp_path: Path) -> None:
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    options = ("--port", str(port), "--no-browser", "--IdentityProvider.token=abc")
    began = time.monotonic()
    server = subprocess.Popen([scripts / "camkit", "lab", "here", *options], cwd=tmp_path, env=alone())
    try:
        at = f"http://127.0.0.1:{port}"
        first = json.loads(answer(f"{at}/api/contents/00_start_here.ipynb?token=abc", server))
        print(f"\nJupyterLab answers after {time.monotonic() - began:.1f} s")
        assert first["content"]["cells"][0]["cell_type"] == "markdown"
        assert "jupyter-config-data" in answer(f"{at}/lab/tree/00_start_here.ipynb?token=abc", server)
        widgets = answer(f"{at}/lab/api/settings/@jupyter-widgets/jupyterlab-manager:plugin?token=abc", server)
        assert json.loads(widgets)["schema"]["properties"]["saveState"]["default"] is True
        kernels = json.loads(answer(f"{at}/api/kernelspecs?token=abc", server))
        assert Path(kernels["kernelspecs"]["python3"]["resources"]["logo-svg"]).name
    finally:
        server.terminate()
        server.wait(30)


def test_the_cell_for_colab_shows_an_instrument(scripts: Path, tmp_path: Path) -> None:
    text = (REPOSITORY / "docs/elsewhere.md").read_text(encoding="utf-8")
    cell = re.search(r"```python\n(%pip .*?)```", text, re.DOTALL)[1]  # type: ignore[index]
    said = ended(scripts / "python", "-c", RUN, input=cell, cwd=tmp_path, env=alone())
    (shown,) = [out for out in json.loads(said) if out["output_type"] in ("display_data", "execute_result")]
    assert "application/vnd.jupyter.widget-view+json" in shown["data"]
