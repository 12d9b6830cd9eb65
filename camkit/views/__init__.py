"""Views: ``view(analysis) -> Picture``.  They compute no physics, and know numpy and units only."""

from .cam import CAM_VIEWS as CAM_VIEWS
from .cam import cam_torque as cam_torque
from .cam import contact_force as contact_force
from .cam import curvature as curvature
from .cam import efficiency as efficiency
from .cam import mechanism as mechanism
from .cam import motion as motion
from .cam import pressure_angle as pressure_angle
from .design_map import ShownPlane as ShownPlane
from .design_map import design_plane as design_plane
from .design_map import designs_on_plane as designs_on_plane
from .design_map import objective_plane as objective_plane
from .picture import Picture as Picture
from .picture import View as View
from .progress import candidates as candidates
