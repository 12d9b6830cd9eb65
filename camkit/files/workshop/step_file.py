"""STEP files (ISO 10303-21, AP214): named solids written and read by Open CASCADE, every name in any script."""

from __future__ import annotations

import io
import re
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from ...quantities.markup import plain
from ...units import mm
from .title import TitleBlock

if TYPE_CHECKING:
    from OCP.collections import Sequence_TDF_Label
    from OCP.TDF import TDF_Label
    from OCP.TDocStd import TDocStd_Document
    from OCP.TopoDS import TopoDS_Shape
    from OCP.XCAFDoc import XCAFDoc_ShapeTool

UNITS = {"mm": "MM", "in": "INCH"}


class Named(NamedTuple):
    """A shape, its name, and how high it stands over the others' zero, m."""

    name: str
    shape: TopoDS_Shape
    height: float = 0.0


def step_file(name: str, parts: Sequence[Named], unit: str, title: TitleBlock, lines: Sequence[str]) -> bytes:
    """One part, or an assembly of several, in ``unit`` (``"mm"``, ``"in"``), with ``lines`` that describe it."""
    from OCP.Interface import Interface_Static
    from OCP.STEPCAFControl import STEPCAFControl_Writer

    _quiet()
    names = [name] if len(parts) == 1 else [name, *(part.name for part in parts)]
    document, tool = _document()
    _assemble(tool, parts) if parts[1:] else _add(tool, parts[0].shape, 0)
    writer, out = STEPCAFControl_Writer(), io.BytesIO()
    Interface_Static.SetCVal_s("write.step.unit", UNITS[unit])
    Interface_Static.SetCVal_s("write.step.schema", "AP214IS")
    writer.Transfer(document)
    writer.WriteStream(out)
    written = re.sub(r"camkit-(\d+)-", lambda found: quoted(names[int(found[1])]), out.getvalue().decode("ascii"))
    schema = re.search(r"FILE_SCHEMA.*?;", written, re.DOTALL)
    body = written[written.index("ENDSEC;") :]
    return "\n".join(
        ["ISO-10303-21;", "HEADER;", *_head(name, title, lines), schema[0] if schema else "", body]
    ).encode()


def _head(name: str, title: TitleBlock, lines: Sequence[str]) -> Iterator[str]:
    described = ",".join(f"'{quoted(line)}'" for line in lines)
    yield f"FILE_DESCRIPTION(({described}),'2;1');"
    author, program = quoted(title.author), quoted(lines[-1])
    yield f"FILE_NAME('{quoted(name)}','{quoted(title.day)}',('{author}'),(''),'Open CASCADE','{program}','');"


def quoted(text: str) -> str:
    r"""As a STEP file holds it: ASCII, with anything else by its number; a line break is a space.

    >>> print(quoted("a 'cam' é"))
    a ''cam'' \X2\00E9\X0\
    """
    line = plain(text).replace("\\", "\\\\").replace("'", "''")
    return re.sub(r"[^\x20-\x7e]", lambda c: _by_number(ord(c[0])), line)


def _by_number(code: int) -> str:
    return rf"\X2\{code:04X}\X0" "\\" if code < 0x10000 else rf"\X4\{code:08X}\X0" "\\"


def _quiet() -> None:
    """Keep Open CASCADE from printing how far it is."""
    from OCP.Message import Message, Message_Gravity

    for printer in Message.DefaultMessenger_s().Printers():
        printer.SetTraceLevel(Message_Gravity.Message_Fail)


def _document() -> tuple[TDocStd_Document, XCAFDoc_ShapeTool]:
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document
    from OCP.XCAFDoc import XCAFDoc_DocumentTool

    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    return document, XCAFDoc_DocumentTool.ShapeTool_s(document.Main())


def _assemble(tool: XCAFDoc_ShapeTool, parts: Sequence[Named]) -> None:
    from OCP.gp import gp_Trsf, gp_Vec
    from OCP.TopLoc import TopLoc_Location

    whole = tool.NewShape()
    _name(whole, 0)
    for number, part in enumerate(parts, 1):
        up = gp_Trsf()
        up.SetTranslation(gp_Vec(0, 0, part.height / mm))
        _name(tool.AddComponent(whole, _add(tool, part.shape, number), TopLoc_Location(up)), number)
    tool.UpdateAssemblies()


def _add(tool: XCAFDoc_ShapeTool, shape: TopoDS_Shape, number: int) -> TDF_Label:
    label = tool.AddShape(shape, False)
    _name(label, number)
    return label


def _name(label: TDF_Label, number: int) -> None:
    """A mark in place of a name: Open CASCADE breaks its lines within letters that are no ASCII."""
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name

    TDataStd_Name.Set_s(label, TCollection_ExtendedString(f"camkit-{number}-"))


def read_step(data: bytes) -> tuple[str, list[Named]]:
    """The name of a part or an assembly, and its parts, each where it stands; lengths in mm."""
    from OCP.STEPCAFControl import STEPCAFControl_Reader

    _quiet()
    reader = STEPCAFControl_Reader()
    reader.ReadStream("", io.BytesIO(data))
    document, tool = _document()
    reader.Transfer(document)
    (whole,) = _labels(tool.GetFreeShapes)
    found = _labels(lambda labels: tool.GetComponents_s(whole, labels)) or [whole]
    return _name_of(whole), [Named(_name_of(_original(part)), tool.GetShape_s(part)) for part in found]


def _labels(ask: Callable[[Sequence_TDF_Label], object]) -> list[TDF_Label]:
    from OCP.collections import Sequence_TDF_Label

    labels = Sequence_TDF_Label()
    ask(labels)
    return [labels.Value(number) for number in range(1, labels.Length() + 1)]


def _original(part: TDF_Label) -> TDF_Label:
    """What stands where a part stands, or the part itself."""
    from OCP.TDF import TDF_Label
    from OCP.XCAFDoc import XCAFDoc_ShapeTool

    original = TDF_Label()
    return original if XCAFDoc_ShapeTool.GetReferredShape_s(part, original) else part


def _name_of(label: TDF_Label) -> str:
    from OCP.TDataStd import TDataStd_Name

    name = TDataStd_Name()
    label.FindAttribute(TDataStd_Name.GetID_s(), name)
    return str(name.Get().ToExtString())
