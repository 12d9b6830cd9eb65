"""What a user may write, and what mypy finds in it: the lines marked ``wrong`` and no others."""

from camkit import Cycloidal, Measure, Rise, Study, TranslatingRollerCam, deg, explore, minimise, mm, nsga2, quick_front
from camkit.machines import CabinDoorLinkage, HighSpeedCam, UniversalJointShaft
from camkit.search import Front
from camkit.views import contact_stress, linkage_in_space, pressure_angles, section

height = Measure("height", "mm", lambda analysis: analysis.profile[1].max(-1))
cam = TranslatingRollerCam(base_radius=30 * mm)
study = Study(cam, ["base_radius"], (height,), at_most={height: 60 * mm}, angles=91)
front = nsga2(study, population=20, generations=4, seed=1)
chosen: TranslatingRollerCam = front[0]
quick: Front[TranslatingRollerCam] = quick_front(study, start=front)
smallest = minimise(study, "slsqp", starts=2)
radius: float = smallest.design.base_radius
rise = Rise(60 * deg, 20 * mm, Cycloidal())
other: Study[TranslatingRollerCam] = study.replace(angles=181)
app = explore(cam, free=["base_radius"])
pictures = contact_stress(HighSpeedCam().analyse()), section(UniversalJointShaft().analyse())
drawn = linkage_in_space(CabinDoorLinkage().analyse(), turn=60 * deg)

TranslatingRollerCam(base_radius="x")  # wrong
TranslatingRollerCam(base_radus=30 * mm)  # wrong
Study(30 * mm, ["base_radius"], (height,))  # wrong
Study(cam, ["base_radius"], minimise=(height.name,))  # wrong
Study(cam, ["base_radius"], (height,), angles="many")  # wrong
Measure("height", 1, height.function)  # wrong
nsga2(cam)  # wrong
nsga2(study, population="large")  # wrong
quick_front(study, start=study)  # wrong
minimise(study, 3)  # wrong
small = front[0].bas_radius  # wrong
section(cam)  # wrong
pressure_angles(HighSpeedCam().analyse())  # wrong
contact_stress(CabinDoorLinkage().analyse())  # wrong
name: str = smallest.design.base_radius  # wrong
unit: int = study.objective  # wrong
