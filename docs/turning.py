"""The picture that moves, on the first page and in the README: a cam that turns, and its pressure angle.

python docs/turning.py        # makes docs/_static/turning.png anew, an APNG
"""

import io
from dataclasses import replace
from pathlib import Path

import numpy as np
from PIL import Image

from camkit import TranslatingRollerCam, picture
from camkit.cam import CamAnalysis, max_pressure_angle
from camkit.units import deg, mm
from camkit.views import mechanism, pressure_angle
from camkit.views.picture import Picture, Points

FRAMES, MILLISECONDS, COLOURS, WIDTH = 45, 70, 64, 760
LIMITS = {max_pressure_angle: 30 * deg}
TARGET = Path(__file__).parent / "_static" / "turning.png"


def turning_cam(analysis: CamAnalysis, turn: float = 0.0) -> Picture:
    """The cam and its follower, in one window for all positions."""
    seen = mechanism(analysis, turn)
    window = replace(seen.axes, xlim=(-62, 62), ylim=(-55, 100))
    return Picture.of(window, [mark for mark in seen.marks if mark.role != "trouble"])


def angle_now(analysis: CamAnalysis, turn: float = 0.0) -> Picture:
    """The pressure angle over the turn, with a dot where the cam stands."""
    now = np.interp(turn, analysis.cam_angle, analysis.pressure_angle) / deg
    seen = pressure_angle(analysis, LIMITS)
    return Picture.of(seen.axes, seen.marks, Points("now", [turn / deg], [now], role="follower", size=9))


def frame(cam: TranslatingRollerCam, turn: float) -> Image.Image:
    """The cam and its pressure angle at one position."""
    still = picture(cam, turning_cam, angle_now, turn=turn, width=9, height=4.6)
    image = Image.open(io.BytesIO(still._repr_png_())).convert("RGB")
    return image.resize((WIDTH, round(image.height * WIDTH / image.width)), Image.Resampling.LANCZOS)


def write() -> None:
    """One turn, in a few colours that all frames share."""
    cam = TranslatingRollerCam(groove=False, base_radius=26 * mm)
    frames = [frame(cam, turn) for turn in np.linspace(0, 2 * np.pi, FRAMES, endpoint=False)]
    palette = frames[0].quantize(COLOURS, Image.Quantize.FASTOCTREE)
    few = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in frames]
    few[0].save(TARGET, save_all=True, append_images=few[1:], duration=MILLISECONDS, loop=0, optimize=True)
    print(f"{TARGET.name}: {TARGET.stat().st_size // 1000} kB")


if __name__ == "__main__":
    write()
