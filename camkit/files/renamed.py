"""What had another name in an earlier camkit: one table, by which files that have the earlier names are read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from ..quantities.kinds import shown
from ..units import factor

RENAMED: dict[tuple[str, str], str] = {
    ("DoorHandleCam", "friction"): "friction.coefficient",
    ("DoorHandleCam", "cam_friction_circle [mm]"): "friction.cam_axis [mm]",
    ("DoorHandleCam", "roller_friction_circle [mm]"): "friction.roller_pin [mm]",
    ("DoorHandleCam", "pivot_friction_circle [mm]"): "friction.arm_pivot [mm]",
    ("DoorHandleCam", "lift_arm_mass [kg]"): "lift_load.mass [kg]",
    ("DoorHandleCam", "handle_speed [deg/s]"): "lift_load.speed [rpm]",
    ("DoorHandleCam", "door_torque [N m]"): "lift_load.torque [N m]",
    ("DoorHandleCam", "door_spring [N m/rad]"): "lift_load.spring_rate [N m/rad]",
    ("DoorHandleCam", "gravity [m/s^2]"): "lift_load.gravity [m/s^2]",
    ("DoorHandleCam", "up_angle [deg]"): "lift_load.up_angle [deg]",
    ("DoorHandleCam", "door_torque_table"): "lift_load.torque_table",
    ("DoorHandleCam", "relief_arm_mass [kg]"): "relief_load.mass [kg]",
    ("DoorHandleCam", "flap_torque [N m]"): "-relief_load.torque [N m]",
    ("ValveCam", "speed [rpm]"): "load.speed [rpm]",
    ("ValveCam", "train_mass [kg]"): "load.mass [kg]",
    ("ValveCam", "spring_rate [N/mm]"): "load.spring_rate [N/mm]",
    ("ValveCam", "spring_preload [N]"): "load.preload [N]",
    ("ValveCam", "contact_width [mm]"): "contact.width [mm]",
    ("ValveCam", "cam_modulus [GPa]"): "contact.cam_modulus [GPa]",
    ("ValveCam", "follower_modulus [GPa]"): "contact.follower_modulus [GPa]",
    **{
        (cam, before): now
        for cam in ("HighSpeedCam", "CamLever")
        for before, now in {
            "rise_law": "rise_law.base",
            "return_law": "return_law.base",
            "family": "rise_law.family, return_law.family",
            **{f"{law}_c{i}": f"{law}_law.c{i}" for law in ("rise", "return") for i in range(4)},
            "contact_width [mm]": "contact.width [mm]",
            "cam_modulus [GPa]": "contact.cam_modulus [GPa]",
            "roller_modulus [GPa]": "contact.follower_modulus [GPa]",
        }.items()
    },
    **{
        ("measure", f"{before}{of}{unit}"): f"{now}{of}{unit}"
        for of in ("", ", lift", ", relief", ", worse curve")
        for before, now, unit in (
            ("steepest pressure angle", "maximum pressure angle", " [deg]"),
            ("least convex radius (pitch)", "minimum convex radius of curvature, pitch curve", " [mm]"),
            ("least concave radius (pitch)", "minimum concave radius of curvature, pitch curve", " [mm]"),
            ("undercut margin of the groove", "undercut margin", ""),
            ("work out / work in", "work efficiency", " [%]"),
        )
    },
    **{
        ("measure", before): now
        for before, now in {
            "least convex radius of the stroke (pitch), lift [mm]": (
                "minimum convex radius of curvature of the stroke, pitch curve, lift [mm]"
            ),
            "least convex radius (profile) [mm]": "minimum convex radius of curvature, profile [mm]",
            "cam angle of the least convex radius [deg]": "cam angle of the minimum convex radius [deg]",
            "least convex radius anywhere [mm]": "minimum convex radius of curvature [mm]",
            "least hollow radius [mm]": "minimum concave radius of curvature [mm]",
            "least width of the face [mm]": "minimum width of the face [mm]",
            "least contact force [N]": "minimum contact force [N]",
            "overspeed before the follower jumps [%]": "overspeed before the follower leaves the cam [%]",
            "contact stress F_sigma [N^0.5 mm^-0.5]": "stress index F_sigma [N^0.5 mm^-0.5]",
            "contact stress F_sigma [N^0.5 cm^-0.5]": "stress index F_sigma [N^0.5 cm^-0.5]",
            "wear F_wear [N^1.5 mm^-0.5]": "wear index [N^1.5 mm^-0.5]",
            "wear F_wear [N^1.5 cm^-0.5]": "wear index [N^1.5 cm^-0.5]",
            "peak cam torque [N mm]": "peak cam torque without friction [N mm]",
            "peak cam torque, lift [N mm]": "peak cam torque without friction, lift [N mm]",
            "peak cam torque, relief [N mm]": "peak cam torque without friction, relief [N mm]",
            "peak cam torque, worse curve [N mm]": "peak cam torque without friction, worse curve [N mm]",
            "least normal force [N]": "minimum normal force [N]",
            "speed at which the roller lifts [%]": "speed at which the roller leaves the cam [%]",
            "least travel from the ends (3-4-5: 1)": "minimum travel from the ends (3-4-5: 1)",
            "undercut margin 1 - r kappa": "undercut margin",
            "smallest radius r_k1 [mm]": "minimum radius r_k1 [mm]",
            "steepest pressure angle, crank [deg]": "maximum pressure angle, crank [deg]",
            "steepest pressure angle, rocker [deg]": "maximum pressure angle, rocker [deg]",
            "least transmission angle, crank [deg]": "minimum transmission angle, crank [deg]",
            "least transmission angle, rocker [deg]": "minimum transmission angle, rocker [deg]",
            "least discriminant of the sweep": "minimum discriminant of the sweep",
            "largest velocity ratio": "maximum velocity ratio",
            "least output speed [rpm]": "minimum output speed [rpm]",
            "largest output speed [rpm]": "maximum output speed [rpm]",
            "largest torque in the tube [N m]": "maximum torque in the tube [N m]",
        }.items()
    },
}
"""``{(where, earlier name): name of today}``, both as files write them: with their units.

``where`` is the class whose field or path it is, such as ``"HighSpeedCam"``; or ``"kind"`` for a class, ``"measure"``
for a measure, ``"rule"`` or ``"mode"`` for an entry of a search's menus.  A minus before the new name of a field stands
for a number of the other sign.  What was a field of its own and stands deeper in the design today has a path for its
new name, such as ``"load.spring_rate [N/mm]"``; the order of a file's entries then is the order in which they are put
in, so a law comes before its coefficients.  A field that is several today has their paths with commas between.
What is renamed twice has a row for each of its earlier names.
"""

MANY = 4
"""So many names are remarked on by name."""


class Given(NamedTuple):
    """An entry as it stands in the file."""

    name: str
    value: object
    times: float = 1.0
    """What its number is multiplied by to be in the unit and of the sign that its quantity has today."""


@dataclass(frozen=True)
class Renaming:
    """Finds the names of today for what one file says."""

    renamed: dict[str, str] = field(default_factory=dict)
    """What had another name, each once, without units."""

    @property
    def remarks(self) -> list[str]:
        """What is to be remarked about it.

        >>> Renaming({"largest_radius": "max_radius"}).remarks
        ['largest radius is now max radius']
        """
        each = [f"{before} is now {now}".replace("_", " ") for before, now in self.renamed.items()]
        more = f" and {len(each) - MANY} names more are others" * (len(each) > MANY)
        return [", ".join(each[:MANY]) + more] if each else []

    def name(self, where: str, name: str) -> str:
        """The name of today."""
        now = RENAMED.get((where, name), name)
        if now != name:
            several = [now] if where == "measure" else now.split(", ")
            self.renamed[_parted(name)[0]] = " and ".join(_parted(each)[0].removeprefix("-") for each in several)
        return now

    def entries(self, where: str, entries: Mapping[str, object]) -> dict[str, Given]:
        """The entries of a file by their names of today; those of one quantity by two names are refused.

        >>> found = Renaming().entries("DoorHandleCam", {"handle_speed [deg/s]": 90.0})["lift_load.speed [rpm]"]
        >>> found.name, round(found.times * found.value, 6)
        ('handle_speed [deg/s]', 15.0)
        """
        found: dict[str, Given] = {}
        for name, value in entries.items():
            for now, times in self._of_today(where, name):
                if now in found:
                    both = f"{shown(found[now].name)} and {shown(name)}"
                    raise ValueError(f"the file has {both}, which are one and the same")
                found[now] = Given(name, value, times)
        return found

    def _of_today(self, where: str, name: str) -> Iterator[tuple[str, float]]:
        """The name of today, or several, and what the number is multiplied by."""
        now, (_, unit) = self.name(where, name), _parted(name)
        if now == name:
            yield name, 1.0
            return
        for signed in now.split(", "):
            plain = signed.removeprefix("-")
            yield plain, factor(unit) / factor(_parted(plain)[1]) * (1.0 if plain == signed else -1.0)


def is_earlier(where: str, entries: Iterable[str]) -> bool:
    """Whether a thing was written when its fields had earlier names: one that is a field's name today is no sign of it.

    >>> is_earlier("DoorHandleCam", ["friction", "up_angle [deg]"]), is_earlier("DoorHandleCam", ["friction"])
    (True, False)
    """
    return any((where, name) in RENAMED and not RENAMED[where, name].startswith(f"{name}.") for name in entries)


def fields_renamed(where: str) -> dict[str, list[str]]:
    """Earlier names of the fields of a class, each with those of today.

    >>> fields_renamed("HighSpeedCam")["family"], fields_renamed("DoorHandleCam")["flap_torque [N m]"]
    (['rise_law.family', 'return_law.family'], ['relief_load.torque [N m]'])
    """
    rows = ((before, now.split(", ")) for (there, before), now in RENAMED.items() if there == where)
    return {before: [each.removeprefix("-") for each in several] for before, several in rows}


def _parted(name: str) -> tuple[str, str]:
    """A name in a file without its unit, and the unit."""
    plain, _, unit = name.removesuffix("]").partition(" [")
    return plain, unit
