"""A design of every kind, by name, for tests that hold for all of them."""

from camkit import OscillatingFlatCam, OscillatingRollerCam, TranslatingFlatCam, TranslatingRollerCam
from camkit.cam import BarrelCam, OscillatingBarrelCam
from camkit.cam.force_closure import ContactPair
from camkit.cam.pair import ConjugatePair
from camkit.machines import CabinDoorLinkage, CamLever, DoorHandleCam, HighSpeedCam, UniversalJointShaft, ValveCam

PAIR = {"contact": ContactPair()}
MACHINES = {
    "roller": TranslatingRollerCam(**PAIR),
    "roller in a groove": TranslatingRollerCam(groove=True, **PAIR),
    "face": TranslatingFlatCam(**PAIR),
    "roller on an arm": OscillatingRollerCam(**PAIR),
    "roller on an arm in a groove": OscillatingRollerCam(groove=True, **PAIR),
    "face on an arm": OscillatingFlatCam(**PAIR),
    "roller on a drum": BarrelCam(**PAIR),
    "roller on an arm on a drum": OscillatingBarrelCam(**PAIR),
    "pair of cams": ConjugatePair(),
    "pair of cams on arms": ConjugatePair(OscillatingRollerCam(groove=False)),
    "high speed": HighSpeedCam(),
    "lever": CamLever(),
    "door handle": DoorHandleCam(),
    "valve": ValveCam(),
    "cabin door": CabinDoorLinkage(),
    "shaft": UniversalJointShaft(),
}
