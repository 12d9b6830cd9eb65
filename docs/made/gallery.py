"""Living instruments as files of the site: each computes in the page, without a kernel and without a network."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from sphinx.application import Sphinx

from camkit import (
    DoorHandleCam,
    HighSpeedCam,
    TranslatingFlatCam,
    TranslatingRollerCam,
    UniversalJointShaft,
    ValveCam,
    door_handle_study,
    to_html,
)
from camkit.machines import CabinDoorLinkage, shaft_study
from camkit.study import Study

FOLDER = "instruments"


class Instrument(NamedTuple):
    """One of the gallery: what it is called, what to try, the notebook whose card shows it, and how it is made."""

    title: str
    words: str
    notebook: str
    design: Callable[[], object]
    study: Callable[[], Study] | None = None


INSTRUMENTS = {
    "door-handle": Instrument(
        "A door handle's cam",
        "One disk, two cranks. Shorten the lift arm and watch torque, force and pressure angle.",
        "01_door_handle_cam",
        DoorHandleCam,
        door_handle_study,
    ),
    "roller": Instrument(
        "A roller on a straight guide",
        "Make the base circle smaller until the pressure angle, or undercut, stops you.",
        "05_cam_size",
        lambda: TranslatingRollerCam(groove=False),
    ),
    "flat-face": Instrument(
        "A flat face",
        "No pressure angle at all. How steep a rise does its curvature allow?",
        "04_motion_program",
        TranslatingFlatCam,
    ),
    "high-speed": Instrument(
        "A high-speed cam",
        "Drag a handle on the acceleration: the law itself is a slider.",
        "06_high_speed_cam",
        HighSpeedCam,
    ),
    "valve": Instrument("A valve cam", "How full can a lift be before the cam wears out?", "08_valve_cam", ValveCam),
    "linkage": Instrument(
        "A linkage in space",
        "Turn it on its turntable; the joints lean as they must.",
        "10_spatial_linkage",
        CabinDoorLinkage,
    ),
    "shaft": Instrument(
        "A universal-joint shaft",
        "The lightest tube that twists, bends and buckles little enough.",
        "12_universal_joint_shaft",
        UniversalJointShaft,
        shaft_study,
    ),
}


CARD = """## {title}

[![{title}, a small picture](notebooks/images/cards/{notebook}.png)](notebooks/{notebook}.ipynb)

{words} <a href="{folder}/{name}.html">Open it on a page of its own</a>; its questions stand in a
[notebook](notebooks/{notebook}.ipynb).

<details class="instrument"><summary>Open it here: {title}</summary>
<iframe src="{folder}/{name}.html" title="{title}: the instrument" loading="lazy"></iframe>
</details>"""


def cards() -> str:
    """The gallery: of each instrument a picture, a link, and the instrument itself when it is asked for."""
    named = INSTRUMENTS.items()
    return "\n\n".join(CARD.format(name=name, folder=FOLDER, **one._asdict()) for name, one in named)


def write(app: Sphinx, failed: Exception | None) -> None:
    """Write every instrument into the finished site."""
    if failed is None and app.builder.format == "html":
        folder = Path(app.outdir) / FOLDER
        folder.mkdir(exist_ok=True)
        for name, one in INSTRUMENTS.items():
            study = one.study() if one.study else None
            limits = {"at_most": study.at_most, "at_least": study.at_least} if study else {}
            to_html(one.design(), path=folder / f"{name}.html", **limits)


def setup(app: Sphinx) -> dict[str, bool]:
    app.connect("build-finished", write)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
