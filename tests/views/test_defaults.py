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
from camkit.linkage import DoubleUniversalJoint
from camkit.machines import CabinDoorLinkage, CamLever
from camkit.study import AnalysisCurve
from camkit.views.defaults import VIEW_OF, default_views

DESIGNS = (
    DoorHandleCam(),
    OscillatingRollerCam(),
    OscillatingFlatCam(),
    TranslatingRollerCam(groove=False),
    TranslatingFlatCam(),
    HighSpeedCam(),
    CamLever(),
    ValveCam(),
    CabinDoorLinkage(),
    DoubleUniversalJoint(),
)
every_design = pytest.mark.parametrize("design", DESIGNS, ids=lambda design: type(design).__name__)


@every_design
def test_every_analysis_has_what_it_offers_and_a_view_of_it(design):
    analysis = design.analyse()
    for name in analysis.offers:
        assert all(hasattr(part, name) for part in (analysis, *getattr(analysis, "curves", {}).values())[-1:]), name
    views = default_views(analysis)
    assert views == tuple(VIEW_OF[name] for name in analysis.offers)
    for view in views:
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


def test_what_offers_nothing_needs_views():
    with pytest.raises(ValueError, match="the picture needs one or more views"):
        picture(SimpleNamespace(cam_angle=np.zeros(3)))
