#pragma once

namespace pintle {

/// mechanism.py, which shows mechanism.pvd beside it: for ParaView 5.9 and later.
inline constexpr const char* paraview_macro = R"py(# Shows the animation beside this file in ParaView:  paraview --script=mechanism.py
# As a picture, of a time if one is named:            pvbatch mechanism.py picture.png [TIME]
import os
import sys
import xml.etree.ElementTree as ElementTree

from paraview.simple import *

folder = os.path.dirname(os.path.abspath(globals().get("__file__") or "mechanism.py"))


def series():
    """The files of mechanism.pvd, part by part: lines and forces, then flexible bodies, then what is of the whole run."""
    parts, times = {}, []
    for entry in ElementTree.parse(os.path.join(folder, "mechanism.pvd")).iter("DataSet"):
        files = parts.setdefault(int(entry.get("part", "0")), [])
        if entry.get("part", "0") == "0":
            times.append(float(entry.get("timestep")))
        file = os.path.join(folder, entry.get("file"))
        if file not in files:
            files.append(file)
    return [parts[part] for part in sorted(parts)], times


def reader(files):
    source = XMLUnstructuredGridReader(FileName=files)
    if len(files) > 1 and hasattr(source, "TimeArray"):
        source.TimeArray = "TimeValue"
    name = os.path.basename(files[0])[:-len(".vtu")]
    RenameSource("lines" if name == "00000" else name[:-6] if name.endswith("_00000") else name, source)
    source.UpdatePipeline()
    return source


def parts_of(source, name, first, last):
    """The cells whose `part` is between two."""
    cells = Threshold(Input=source, Scalars=["CELLS", "part"])
    if hasattr(cells, "LowerThreshold"):
        cells.LowerThreshold, cells.UpperThreshold, cells.ThresholdMethod = first, last, "Between"
    else:
        cells.ThresholdRange = [first, last]
    RenameSource(name, cells)
    return cells


def names_of(source, array):
    names = source.GetClientSideObject().GetOutputDataObject(0).GetFieldData().GetAbstractArray(array)
    return [names.GetValue(i) for i in range(names.GetNumberOfValues())]


def style_bar(table, view, title):
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    bar.LabelColor = bar.TitleColor = [0.1, 0.1, 0.1]
    bar.LabelFontSize = bar.TitleFontSize = 14
    bar.ScalarBarLength = 0.25


def show_bodies(source, view):
    display = Show(source, view, "UnstructuredGridRepresentation")
    display.Representation = "Surface With Edges"
    display.Opacity = 0.8
    if source.CellData.GetArray("colour"):
        ColorBy(display, ("CELLS", "colour"))
        display.MapScalars = 0
        return
    ColorBy(display, ("CELLS", "owner"))
    palette = [(0.00, 0.45, 0.70), (0.84, 0.37, 0.00), (0.00, 0.62, 0.45), (0.80, 0.47, 0.65), (0.34, 0.71, 0.91), (0.90, 0.62, 0.00)]
    cells = source.GetClientSideObject().GetOutputDataObject(0).GetCellData()
    owners = sorted({int(cells.GetArray("owner").GetValue(i)) for i in range(source.GetDataInformation().GetNumberOfCells())})
    table = GetColorTransferFunction("owner")
    table.InterpretValuesAsCategories = 1
    names = names_of(lines, "owners")
    table.Annotations = [text for owner in owners for text in (str(owner), names[owner])]
    table.IndexedColors = [channel for k in range(len(owners)) for channel in palette[k % len(palette)]]
    display.SetScalarBarVisibility(view, len(owners) <= 20)
    style_bar(table, view, "")


def show_lines(source, view, colour, width):
    display = Show(source, view, "UnstructuredGridRepresentation")
    display.Representation = "Wireframe"
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = colour
    display.LineWidth = width


def show_forces(source, view, size, largest):
    arrows = Glyph(Input=source, GlyphType="Arrow")
    arrows.OrientationArray = ["POINTS", "force [N]"]
    arrows.ScaleArray = ["POINTS", "force [N]"]
    arrows.ScaleFactor = 0.25 * size / largest
    arrows.GlyphMode = "All Points"
    arrows.GlyphType.TipLength, arrows.GlyphType.TipRadius, arrows.GlyphType.ShaftRadius = 0.2, 0.05, 0.015
    RenameSource("forces", arrows)
    display = Show(arrows, view, "GeometryRepresentation")
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = [0.80, 0.16, 0.14]
    display.Ambient, display.Diffuse = 1, 0


def show_flexible(source, view, stress):
    display = Show(source, view, "UnstructuredGridRepresentation")
    ColorBy(display, ("POINTS", "von Mises [Pa]"))
    display.SetScalarBarVisibility(view, True)
    table = GetColorTransferFunction("von Mises [Pa]")
    table.RescaleTransferFunction(0, stress or 1)
    style_bar(table, view, "von Mises [Pa]")


def show_impacts(source, view):
    display = Show(source, view, "UnstructuredGridRepresentation")
    display.Representation = "Points"
    display.PointSize = 9
    display.RenderPointsAsSpheres = 1
    ColorBy(display, ("POINTS", "peak force [N]"))
    display.SetScalarBarVisibility(view, True)
    style_bar(GetColorTransferFunction("peak force [N]"), view, "impacts: peak force [N]")


def survey(moving, forces, times):
    """What moves, over some times, as xmin, xmax, ymin, ymax; the force that arrows are measured by; the greatest stress."""
    box, largest, stress = [1e300, -1e300, 1e300, -1e300], [], 0
    for time in times[:: max(1, len(times) // 25)]:
        for source in moving:
            source.UpdatePipeline(time)
            b = source.GetDataInformation().GetBounds()
            if b[0] <= b[1]:
                box = [min(box[0], b[0]), max(box[1], b[1]), min(box[2], b[2]), max(box[3], b[3])]
            if source.PointData.GetArray("von Mises [Pa]"):
                stress = max(stress, source.PointData["von Mises [Pa]"].GetRange(0)[1])
        forces.UpdatePipeline(time)
        if forces.GetDataInformation().GetNumberOfPoints() > 0:
            largest.append(forces.PointData["force [N]"].GetRange(-1)[1])
    return box, sorted(largest)[int(0.9 * (len(largest) - 1))] if largest else 0, stress


files, times = series()
readers = [reader(part) for part in files]
lines, others = readers[0], readers[1:]
view = GetActiveViewOrCreate("RenderView")
if len(sys.argv) > 1:
    view.ViewSize = [1400, 1000]
bodies, cylinders, forces = parts_of(lines, "bodies", 0, 0), parts_of(lines, "cylinders", 7, 7), parts_of(lines, "forces at points", 9, 12)
flexible = [source for source in others if source.FieldData.GetArray("body")]
box, largest, stress = survey([bodies, cylinders, *flexible], forces, times)
size = max(box[1] - box[0], box[3] - box[2], 1e-9)

view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
view.InteractionMode = "2D"
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
wanted = float(sys.argv[2]) if len(sys.argv) > 2 else times[-1] if len(sys.argv) > 1 else times[0]
for source in (bodies, cylinders):
    source.UpdatePipeline(wanted)
if bodies.GetDataInformation().GetNumberOfCells() > 0:
    show_bodies(bodies, view)
for name, first, last, colour, width in (("ground", 8, 8, [0.55, 0.55, 0.6], 1), ("guides", 5, 5, [0.55, 0.55, 0.6], 2),
                                         ("joints", 1, 3, [0.1, 0.1, 0.1], 2), ("springs", 4, 4, [0.3, 0.3, 0.35], 2)):
    show_lines(parts_of(lines, name, first, last), view, colour, width)
show_lines(cylinders, view, [0.3, 0.3, 0.35], 3)
for source in flexible:
    show_flexible(source, view, stress)
for source in others:
    if source.PointData.GetArray("peak force [N]"):
        show_impacts(source, view)
    elif source not in flexible:
        show_lines(source, view, [0.6, 0.6, 0.65], 1)
if largest > 0:
    show_forces(forces, view, size, largest)

time = AnnotateTimeFilter(Input=lines)
time.Format = "t = {time:.6g} s" if GetParaViewVersion() >= 5.10 else "t = %g s"
label = Show(time, view)
label.Color, label.FontSize = [0.1, 0.1, 0.1], 20
label.WindowLocation = "Upper Left Corner" if GetParaViewVersion() >= 5.10 else "UpperLeftCorner"

view.CameraParallelProjection = 1
view.CameraFocalPoint = [(box[0] + box[1]) / 2, (box[2] + box[3]) / 2, 0]
view.CameraPosition = [*view.CameraFocalPoint[:2], 10 * size]
view.CameraViewUp = [0, 1, 0]
shape = view.ViewSize
view.CameraParallelScale = 0.62 * max(box[3] - box[2], (box[1] - box[0]) * shape[1] / shape[0], 1e-9)
scene.AnimationTime = wanted
view.ViewTime = wanted
Render(view)
if len(sys.argv) > 1:
    SaveScreenshot(sys.argv[1], view, ImageResolution=[1400, 1000])
)py";

}  // namespace pintle
