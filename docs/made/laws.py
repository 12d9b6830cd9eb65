"""Motion laws beside each other: what each asks of the machine, computed anew for the page."""

from camkit import LAWS, MotionProgram, TranslatingRollerCam, deg, mm, rpm
from camkit.cam import SlideLoad, peak_torque
from camkit.dynamics import ElasticFollower, ElasticTrain, contact_loss
from camkit.motion import ConstantVelocity, Dwell, Law, Return, Rise, residual_vibration

from .tables import best, table

ALL = (*LAWS, ConstantVelocity())
PERIODS = (1.0, 2.0, 4.0, 8.0)
STEEP = 30 * deg


def peaks() -> str:
    """Peak velocity, acceleration and jerk of each law, and how smooth it joins a dwell."""
    found = [law.peaks() for law in ALL]
    columns = [best([float(peak[k]) for peak in found]) for k in range(3)]
    smooth = best([law.continuity for law in ALL], least=False)
    names = [law.name for law in ALL]
    head = ("law", "$C_v$", "$C_a$", "$C_j$", "continuous derivatives at a dwell")
    return table(head, zip(names, *columns, smooth, strict=True))


def loudest(law: Law, periods: float) -> float:
    """The largest swing left after a rise of about so many natural periods; the notches between are left out."""
    near = [periods + step / 20 for step in range(-10, 11)]
    return 100 * float(max(residual_vibration(law, near).residual))


def shaking() -> str:
    """What still swings after the rise, in percent of it."""
    columns = [best([loudest(law, tau) for law in ALL], 3) for tau in PERIODS]
    head = ("law", *(f"about {tau:g} periods" for tau in PERIODS))
    return table(head, zip([law.name for law in ALL], *columns, strict=True))


def cam(law: Law) -> TranslatingRollerCam:
    """A plate cam that lifts 2 kg by 20 mm within 60 deg and lets them down again, at 300 rpm against a spring."""
    parts = (Rise(60 * deg, 20 * mm, law), Dwell(60 * deg), Return(60 * deg, 20 * mm, law), Dwell(180 * deg))
    load = SlideLoad(mass=2.0, speed=300 * rpm, spring_rate=5e3, preload=400.0)
    made = TranslatingRollerCam(MotionProgram(parts), groove=False, load=load)
    return made.replace(base_radius=made.base_radius_for(pressure_angle=STEEP))


def machine() -> str:
    """The same task with each law: size of the cam, torque, and the speed at which an elastic train leaves the cam."""
    cams = [cam(law) for law in ALL]
    sizes = best([float(made.base_radius / mm) for made in cams])
    torques = best([float(peak_torque(made.analyse())) for made in cams], 3)
    lost = [float(contact_loss(ElasticFollower(made, ElasticTrain(stiffness=8e5)).analyse()) / rpm) for made in cams]
    head = ("law", "base radius for 30°, mm", "peak torque, N m", "leaves the cam at, rpm")
    return table(head, zip([law.name for law in ALL], sizes, torques, best(lost, 4, least=False), strict=True))
