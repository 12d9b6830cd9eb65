"""Cams for 3D printing: STL and 3MF, read back: watertight, and how far from the exact flanks."""

from __future__ import annotations

import io
import xml.etree.ElementTree as xml
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from ...quantities.extras import extra
from ...quantities.markup import attribute, escaped, plain
from ...quantities.types import Array
from ...units import mm, um
from .blank import Blank
from .drum import drum_mesh
from .faults import marked
from .mesh import Mesh, mesh, off
from .prisms import Part, parts
from .subject import design_of, subjects
from .title import TitleBlock
from .written import LENGTHS, Made, Written, length_unit, new_file, written, zipped

STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
"""A triangle of a binary STL file."""
APART = 10 * mm
"""Between cams that are printed beside each other."""
UNITS = {"mm": "millimeter", "in": "inch"}
SPACE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
PACKAGE = "http://schemas.openxmlformats.org/package/2006"
MODEL = "3D/3dmodel.model"
XML = '<?xml version="1.0" encoding="UTF-8"?>\n'
TYPES = (
    f"{XML}<Types {attribute('xmlns', f'{PACKAGE}/content-types')}>"
    '<Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    '<Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>'
)
RELATIONS = (
    f"{XML}<Relationships {attribute('xmlns', f'{PACKAGE}/relationships')}><Relationship Target='/{MODEL}' Id='model' "
    'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>'
)


def write_stl(
    cam: object,
    path: str | Path,
    *,
    tolerance: float = 10 * um,
    title: TitleBlock = TitleBlock(),
    blank: Blank = Blank(),
) -> Written:
    """Write a cam for a 3D printer as binary STL in mm; it needs the extra ``print``.  See `stl`."""
    path = new_file(path, "an STL file", (".stl",))
    return written(stl(cam, tolerance=tolerance, title=title, blank=blank), path)


def write_3mf(
    cam: object,
    path: str | Path,
    *,
    tolerance: float = 10 * um,
    unit: str = "mm",
    title: TitleBlock = TitleBlock(),
    blank: Blank = Blank(),
) -> Written:
    """Write a cam for a 3D printer as 3MF, which says its unit; it needs the extra ``print``.  See `three_mf`."""
    path = new_file(path, "a 3MF file", (".3mf",))
    return written(three_mf(cam, tolerance=tolerance, unit=unit, title=title, blank=blank), path)


def stl(cam: object, *, tolerance: float = 10 * um, title: TitleBlock = TitleBlock(), blank: Blank = Blank()) -> Made:
    """A cam as binary STL, in mm as all printers take it: watertight, flanks within the tolerance (m).

    The solid is that of `step`; the cams of a pair lie beside each other.  Raises ``ValueError`` as that does.
    """
    name, bodies = marked(title, cam).marked(type(design_of(cam)).__name__), _bodies(cam, blank, tolerance)
    corners = np.concatenate([body.mesh.points[body.mesh.triangles] for body in bodies]) / mm
    written_as = corners.astype(STL["corners"].base)  # corners that fall together there leave no triangle
    corners = corners[(written_as != np.roll(written_as, 1, axis=1)).any(2).all(1)]
    out = np.zeros(len(corners), STL)
    out["corners"] = corners
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    out["normal"] = normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30)
    head = f"camkit, lengths in mm: {name}".encode("ascii", "replace")[:80].ljust(80)
    data = head + np.uint32(len(out)).tobytes() + out.tobytes()
    return _read_back(data, read_stl(data), bodies, tolerance, ", lengths in mm")


def read_stl(data: bytes) -> Mesh:
    """The mesh of a binary STL file in mm; corners with the same numbers are one point."""
    corners = np.frombuffer(data, STL, int(np.frombuffer(data, "<u4", 1, 80)[0]), 84)["corners"].reshape(-1, 3)
    points, which = np.unique(corners, axis=0, return_inverse=True)
    return Mesh(points * mm, which.reshape(-1, 3))


def three_mf(
    cam: object,
    *,
    tolerance: float = 10 * um,
    unit: str = "mm",
    title: TitleBlock = TitleBlock(),
    blank: Blank = Blank(),
) -> Made:
    """A cam as 3MF: as `stl`, with its unit, title and author in the file; a pair is two objects."""
    unit, kind = length_unit(unit), type(design_of(cam)).__name__
    bodies, title = _bodies(cam, blank, tolerance), marked(title, cam)
    facts = {"Title": title.marked(kind), "Designer": title.author, "CreationDate": title.day}
    facts["Description"] = "; ".join(title.lines(kind, unit, f"flanks within {tolerance / um:.3g} um"))
    said = "".join(
        f"<metadata {attribute('name', name)}>{_text(value)}</metadata>" for name, value in facts.items() if value
    )
    objects = "".join(_object(number, body, LENGTHS[unit]) for number, body in enumerate(bodies, 1))
    items = "".join(f"<item {attribute('objectid', number)}/>" for number in range(1, len(bodies) + 1))
    model = (
        f"{XML}<model {attribute('unit', UNITS[unit])} xml:lang='en' {attribute('xmlns', SPACE)}>{said}"
        f"<resources>{objects}</resources><build>{items}</build></model>"
    )
    data = zipped({"[Content_Types].xml": TYPES, "_rels/.rels": RELATIONS, MODEL: model})
    return _read_back(data, read_3mf(data), bodies, tolerance)


def _object(number: int, body: Body, unit: float) -> str:
    """An object of a 3MF file."""
    vertex, triangle = "<vertex x='%.9g' y='%.9g' z='%.9g'/>", "<triangle v1='%d' v2='%d' v3='%d'/>"
    points = "".join(vertex % tuple(point) for point in body.mesh.points / unit)
    triangles = "".join(triangle % tuple(corners) for corners in body.mesh.triangles)
    mesh = f"<mesh><vertices>{points}</vertices><triangles>{triangles}</triangles></mesh>"
    said = f"{attribute('id', number)} type='model' {attribute('name', plain(body.name))}"
    return f"<object {said}>{mesh}</object>"


def read_3mf(data: bytes) -> Mesh:
    """All objects of a 3MF file as one mesh."""
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        model = xml.fromstring(archive.read(MODEL))
    unit = {name: LENGTHS[key] for key, name in UNITS.items()}[model.attrib["unit"]]
    points, triangles, before = [], [], 0
    for each in model.iter(f"{{{SPACE}}}mesh"):
        vertices = [[float(vertex.attrib[axis]) for axis in "xyz"] for vertex in each.iter(f"{{{SPACE}}}vertex")]
        corners = [[int(t.attrib[key]) for key in ("v1", "v2", "v3")] for t in each.iter(f"{{{SPACE}}}triangle")]
        points.append(np.array(vertices) * unit)
        triangles.append(np.array(corners) + before)
        before += len(vertices)
    return Mesh(np.concatenate(points), np.concatenate(triangles))


class Body(NamedTuple):
    """What is printed in one piece."""

    name: str
    mesh: Mesh
    exact: Array
    """Points on the exact flanks, ``(n, 3)``, m."""
    volume: float
    """Without chords in place of arcs, m^3."""

    def beside(self, other: Body) -> Body:
        """The same, moved along the x axis until it lies beside another one."""
        shift = other.mesh.points[:, 0].max() + APART - self.mesh.points[:, 0].min()
        return self._replace(mesh=self.mesh.moved(shift), exact=self.exact + np.array([shift, 0.0, 0.0]))


def _bodies(cam: object, blank: Blank, tolerance: float) -> list[Body]:
    """The cams beside each other, each within the tolerance."""
    with extra("a mesh", "print"):
        import manifold3d  # noqa: F401
    first = subjects(cam)[0]
    if first.drum:
        made, exact = drum_mesh(first, blank, tolerance)
        return [Body(first.name, made, exact, made.volume)]
    found = [_body(part, blank, tolerance) for part in parts(cam, blank, tolerance / 2)]
    return found[:1] + [body.beside(found[0]) for body in found[1:]]


def _body(part: Part, blank: Blank, tolerance: float) -> Body:
    """A cam of which the arcs keep one half of the tolerance, the chords the other."""
    return Body(part.name, mesh(part, tolerance / 2), _on_flanks(part, blank), part.volume)


def _on_flanks(part: Part, blank: Blank) -> Array:
    """Points of the exact flanks, halfway between the disk's faces or below its face and the groove's bottom, m."""
    low = max((pocket.low for pocket in part.cut), default=0.0)
    points = np.hstack([stretch.finer(2).points for flank in part.flanks for stretch in flank.stretches])
    return np.column_stack([*points, np.full(points.shape[1], (low + blank.thickness) / 2)])


def _read_back(data: bytes, read: Mesh, bodies: Sequence[Body], tolerance: float, said: str = "") -> Made:
    """The file with what is found on reading it: watertight, normals outwards, of the right volume, how far off."""
    volume = sum(body.volume for body in bodies)
    if not read.watertight or not abs(read.volume - volume) <= tolerance * read.area:
        raise ValueError(
            f"the file holds {read.volume / mm**3:.6g} mm3{'' if read.watertight else ', not watertight,'} where there "
            f"were to be {volume / mm**3:.6g} mm3; another tolerance may help"
        )
    away = max(float(off(read, body.exact).max()) for body in bodies)
    pieces = "1 body" if len(bodies) == 1 else f"{len(bodies)} bodies beside each other"
    return Made(data, f"{pieces} of {len(read.triangles)} triangles, {read.volume / mm**3:.6g} mm3{said}", away)


def _text(text: str) -> str:
    return escaped(plain(text))
