"""Followers beside each other: the same motion and load through a cam of each kind."""

import numpy as np

from camkit import MPa, OscillatingFlatCam, OscillatingRollerCam, TranslatingFlatCam, TranslatingRollerCam, deg, mm, rpm
from camkit.cam import (
    ArmLoad,
    CamAnalysis,
    ContactPair,
    SlideLoad,
    face_width,
    jump_speed,
    max_pressure_angle,
    mean_efficiency,
    peak_force,
    peak_pressure,
    peak_torque,
)
from camkit.geometry import angle_opposite
from camkit.motion import Cycloidal, Dwell, MotionProgram, Return, Rise

from .tables import best, cell, table

LIFT, ARM = 10 * mm, 80 * mm
BASE, ROLLER, CENTRE = 40 * mm, 8 * mm, 100 * mm
ROCKED = float(angle_opposite(BASE + ROLLER, CENTRE, ARM))
"""The arm's angle at which its roller is as far from the axis as the others."""


def motion(lift: float) -> MotionProgram:
    law = Cycloidal()
    return MotionProgram((Rise(90 * deg, lift, law), Dwell(60 * deg), Return(90 * deg, lift, law), Dwell(120 * deg)))


SLIDE = SlideLoad(mass=2.0, speed=300 * rpm, spring_rate=5e3, preload=150.0)
TURNED = ArmLoad(mass=2.0, speed=300 * rpm, spring_rate=5e3 * ARM**2, preload=150.0 * ARM)
"""The same spring and preload, as felt at the end of the arm."""


def cams() -> dict[str, object]:
    """A plate cam of each kind that moves its follower by 10 mm: straight, or along the arc of an arm of 80 mm."""
    slide = {"motion": motion(LIFT), "load": SLIDE, "base_radius": BASE, "contact": ContactPair()}
    turned = {"motion": motion(LIFT / ARM), "load": TURNED, "contact": ContactPair(), "centre_distance": CENTRE}
    turned_roller = turned | {"arm_length": ARM, "roller_radius": ROLLER, "start_angle": ROCKED}
    turned_face = turned | {"arm_length": 140 * mm, "face_offset": 0, "start_angle": np.arcsin(BASE / CENTRE)}
    return {
        "roller, straight guide": TranslatingRollerCam(**slide, groove=False),
        "flat face, straight guide": TranslatingFlatCam(**slide),
        "roller on an arm": OscillatingRollerCam(**turned_roller, groove=False),
        "flat face on an arm": OscillatingFlatCam(**turned_face),
    }


MEASURES = {
    "base radius, mm": (lambda a: base(a) / mm, None),
    "max. pressure angle, °": (lambda a: max_pressure_angle(a) / deg, True),
    "peak contact force, N": (peak_force, True),
    "peak contact pressure, MPa": (lambda a: peak_pressure(a) / MPa, True),
    "peak torque, N m": (peak_torque, True),
    "mean efficiency, %": (lambda a: 100 * mean_efficiency(a), False),
    "leaves the cam at, rpm": (lambda a: jump_speed(a) / rpm, False),
}


def base(analysis: CamAnalysis) -> float:
    """The least distance of the profile from the cam axis, m."""
    return float(np.hypot(*analysis.profile).min())


def compared() -> str:
    """The same task with each follower."""
    found = {name: cam.analyse() for name, cam in cams().items()}
    columns = []
    for of, least in MEASURES.values():
        values = [float(of(analysis)) for analysis in found.values()]
        columns.append([cell(value, 3) for value in values] if least is None else best(values, 3, least))
    return table(("follower", *MEASURES), zip(found, *columns, strict=True))


def sized() -> str:
    """How large the base circle of each straight follower has to be, for the same rise within less of a turn."""
    angles = (120, 90, 60, 45, 30)
    roller, flat = TranslatingRollerCam(groove=False, roller_radius=ROLLER), TranslatingFlatCam()
    rows = []
    for angle in angles:
        law, rest = Cycloidal(), (360 - 2 * angle) * deg
        program = MotionProgram((Rise(angle * deg, LIFT, law), Return(angle * deg, LIFT, law), Dwell(rest)))
        wide = roller.replace(motion=program).base_radius_for(pressure_angle=30 * deg, min_radius=5 * mm)
        face = flat.replace(motion=program)
        least = face.base_radius_for(min_radius=5 * mm)
        width = face_width(face.replace(base_radius=least).analyse())
        rows.append((f"{angle}°", float(wide / mm), float(least / mm), float(width / mm)))
    first = f"{LIFT / mm:g} mm within"
    head = (first, "roller, 30° at most: base radius, mm", "flat face: base radius, mm", "its face, mm")
    return table(head, rows)
