"""What is shown where nobody chooses follows from what the analysis offers."""

from types import SimpleNamespace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import (
    DoorHandleCam,
    HighSpeedCam,
    OscillatingFlatCam,
    OscillatingRollerCam,
    TranslatingFlatCam,
    TranslatingRollerCam,
    ValveCam,
    deg,
    mm,
    picture,
)
from camkit.cam import BarrelCam, OscillatingBarrelCam
from camkit.cam.pair import ConjugatePair
from camkit.linkage import DoubleUniversalJoint, Driveline
from camkit.machines import CabinDoorLinkage, CamLever
from camkit.quantities import with_quantities
from camkit.study import AnalysisCurve
from camkit.views.defaults import VIEW_OF, default_views

DESIGNS = (
    DoorHandleCam(),
    OscillatingRollerCam(),
    OscillatingFlatCam(),
    TranslatingRollerCam(groove=False),
    TranslatingFlatCam(),
    BarrelCam(),
    OscillatingBarrelCam(),
    BarrelCam(groove=False),
    HighSpeedCam(),
    CamLever(),
    ValveCam(),
    CabinDoorLinkage(),
    DoubleUniversalJoint(),
    Driveline(),
)
every_design = pytest.mark.parametrize("design", DESIGNS, ids=lambda design: type(design).__name__)


@every_design
def test_every_analysis_has_what_it_offers_and_a_view_of_it(design):
    analysis = design.analyse()
    names = [offered.name if isinstance(offered, AnalysisCurve) else offered for offered in analysis.offers]
    for name in names:
        assert all(hasattr(part, name) for part in (analysis, *getattr(analysis, "curves", {}).values())[-1:]), name
    views = default_views(analysis)
    for view, offered in zip(views, analysis.offers, strict=True):
        curve = isinstance(offered, AnalysisCurve)
        assert view.__name__ == offered.label.replace(" ", "_") if curve else view is VIEW_OF[offered]
        assert view(analysis).marks, view.__name__


def test_a_mechanism_of_ones_own_offers_curves():
    angle = np.linspace(0, np.pi, 7)
    own = SimpleNamespace(
        cam_angle=angle, travel=np.sin(angle) * mm, offers=(AnalysisCurve("travel", "mm", "travel", (0.5 * mm,)),)
    )
    (view,) = default_views(own)
    shown = view(own)
    assert_allclose(shown["curve"].y, np.sin(angle))
    assert_allclose(shown["curve"].x * deg, angle)
    assert_allclose(shown["limit 0"].y, 0.5)
    assert shown.axes.title == "Travel"
    (ax,) = picture(own).axes
    assert ax.get_title(loc="left") == "Travel"


def test_coefficients_shape_the_acceleration_that_a_cam_then_offers():
    plain = OscillatingRollerCam()
    shaped = with_quantities(plain, {"motion.rise.law": "shaped"})
    assert "acceleration" not in [view.__name__ for view in default_views(plain.analyse(91))]
    (view,) = [view for view in default_views(shaped.analyse(91)) if view.__name__ == "acceleration"]
    curve = view(shaped.analyse(91))["curve"]
    assert (curve.role, curve.shaped) == ("acceleration", True)
    assert_allclose(curve.y, shaped.analyse(91).acceleration)
    sliding = with_quantities(TranslatingRollerCam(), {"motion.return.law": "shaped"})
    (pair,) = ConjugatePair(sliding).analyse(91).shaped
    assert (pair.name, pair.unit) == ("first.acceleration", "mm/rad^2")
    assert_allclose(pair.values(ConjugatePair(sliding).analyse(91)), sliding.analyse(91).acceleration)


def test_what_offers_nothing_needs_views():
    with pytest.raises(ValueError, match="the picture needs one or more views"):
        picture(SimpleNamespace(cam_angle=np.zeros(3)))
