"""What a page that computes takes: recorded and packed by the processor here, run and drawn in Chromium.

``python benchmarks/living_pages.py`` from the repository's root; a table of times in ms: medians of moves
200 to 300, when the engine has compiled what it runs.
"""

import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

ROOT = Path(__file__).parents[1]
sys.path[:0] = [str(ROOT / "tests" / folder) for folder in ("browser", "machines")]

from every_machine import MACHINES  # noqa: E402
from playwright.sync_api import sync_playwright  # noqa: E402

from camkit.render.living import living  # noqa: E402
from lab import CHROMIUM_FLAGS, find_chromium  # noqa: E402

MOVED = """(place) => { const times = [];
    for (let k = 0; k < 300; k++) {
        camkit.values[place] *= 1.0003; camkit.values[place] += 1e-6;
        const begin = performance.now(), outputs = camkit.engine.run(camkit.values), ran = performance.now();
        camkit._draw(outputs, false);
        times.push([ran - begin, performance.now() - ran]);
    }
    const median = (k) => times.slice(200).map((t) => t[k]).sort((a, b) => a - b)[50];
    return [times[0][0], median(0), median(1)]; }"""


def processor(act):
    begin = time.process_time()
    return act(), 1e3 * (time.process_time() - begin)


def main():
    print(f"{'':28}{'record':>8}{'pack':>7}{'file kB':>9}{'first':>8}{'run':>7}{'turn':>7}{'draw':>7}")
    with sync_playwright() as playwright, TemporaryDirectory() as folder:
        browser = playwright.chromium.launch(executable_path=find_chromium(), args=CHROMIUM_FLAGS)
        for name, design in MACHINES.items():
            living(design).structure  # noqa: B018  what is worked out once
            page_of = living(design)
            _, record = processor(lambda page_of=page_of: page_of.structure)
            _, pack = processor(lambda page_of=page_of: page_of.packed)
            path = Path(folder) / "page.html"
            path.write_text(page_of.html(), encoding="utf-8")
            page = browser.new_page(viewport={"width": 934, "height": 612})
            page.goto(path.as_uri())
            page.wait_for_function("() => globalThis.camkit?.outputs && !camkit.frame")
            first, run, draw = page.evaluate(MOVED, 0)
            count = len(page_of.structure["quantities"])
            turn = page.evaluate(MOVED, count)[1] if page_of.structure["positions"] else float("nan")
            size = path.stat().st_size / 1e3
            print(
                f"{name:28}{record:8.0f}{pack:7.0f}{size:9.0f}{first:8.1f}{run:7.2f}{turn:7.2f}{draw:7.2f}", flush=True
            )
            page.close()


if __name__ == "__main__":
    main()
