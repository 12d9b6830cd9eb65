"""Files for the workshop: a table or a drawing holds the profile that was analysed."""

import csv
import io

import ezdxf
import numpy as np
import pytest
from numpy.testing import assert_allclose

from camkit import DoorHandleCam, OscillatingRollerCam, TranslatingRollerCam, ValveCam, profile_csv, profile_dxf
from camkit.units import deg, mm

# ---------------------------------------------------------------- CSV


@pytest.mark.parametrize("design", [DoorHandleCam(), OscillatingRollerCam()], ids=lambda d: type(d).__name__)
def test_the_table_holds_the_analysis(design):
    analysis = design.analyse(181)
    rows = list(csv.DictReader(profile_csv(analysis).splitlines()))
    assert len(rows) == analysis.pitch.shape[-1]
    assert [row["stretch"] for row in rows] == analysis.stretch.tolist()
    column = {name: np.array([float(row[name]) for row in rows]) for name in rows[0] if name != "stretch"}
    assert_allclose(column["cam_angle_deg"], analysis.profile_angle / deg, rtol=0, atol=0.5e-6 + 1e-12)
    for name in ("pitch", "profile", "outer_profile"):
        for axis, values in zip("xy", getattr(analysis, name), strict=True):
            assert_allclose(column[f"{name}_{axis}_mm"], values / mm, rtol=0, atol=0.5e-6 + 1e-12)


@pytest.mark.parametrize("cam", [DoorHandleCam(), TranslatingRollerCam(groove=False), ValveCam()])
def test_a_drawing_holds_the_points_of_the_profile_in_mm(cam):
    """Read back by ezdxf: every point of the profile, in order, closed exactly where the whole cam is."""
    analysis = cam.analyse()
    drawing = ezdxf.read(io.StringIO(profile_dxf(analysis)))
    assert drawing.units == ezdxf.units.MM
    assert not drawing.audit().errors
    (curve,) = drawing.modelspace().query('LWPOLYLINE[layer=="profile"]')
    points = 1e3 * getattr(analysis, "whole", analysis).profile.T
    assert curve.closed == (np.hypot(*(points[0] - points[-1])) < 1e-6)
    assert_allclose(np.array(curve.get_points("xy")), points[: len(points) - curve.closed], atol=1e-9)


def test_a_population_is_not_drawn():
    many = TranslatingRollerCam(base_radius=np.array([[0.03], [0.04]]))
    with pytest.raises(ValueError, match="this is a population; the profile of one design can be written"):
        profile_dxf(many.analyse())
