#pragma once

namespace pintle {

/// mechanism.py, which shows mechanism.pvd beside it: for ParaView 5.9 and later. In it BODY_PALETTE and ARROW_PALETTE stand for lists of
/// colours, GIVERS for a list of names.
inline constexpr const char* paraview_macro = R"py(# Shows the animation beside this file in ParaView:  paraview --script=mechanism.py
# As a picture, of a time if one is named:            pvbatch mechanism.py picture.png [TIME]
import math
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


def between(source, array, least, most):
    cells = Threshold(Input=source, Scalars=array)
    if hasattr(cells, "LowerThreshold"):
        cells.LowerThreshold, cells.UpperThreshold, cells.ThresholdMethod = least, most, "Between"
    else:
        cells.ThresholdRange = [least, most]
    return cells


def parts_of(source, name, *parts):
    """The cells of some parts that follow one another."""
    cells = between(source, ["CELLS", "part"], part_names.index(parts[0]), part_names.index(parts[-1]))
    RenameSource(name, cells)
    return cells


def cell_values(source, array):
    """The values of an array of whole numbers."""
    values = source.GetClientSideObject().GetOutputDataObject(0).GetCellData().GetArray(array)
    return {int(values.GetValue(i)) for i in range(values.GetNumberOfTuples())}


def is_empty(source):
    return source.GetDataInformation().GetNumberOfCells() == 0


def names_of(source, array):
    names = source.GetClientSideObject().GetOutputDataObject(0).GetFieldData().GetAbstractArray(array)
    return [names.GetValue(i) for i in range(names.GetNumberOfValues())]


def style_bar(table, view, title):
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    bar.LabelColor = bar.TitleColor = [0.1, 0.1, 0.1]
    bar.LabelFontSize = bar.TitleFontSize = 14
    bar.ScalarBarLength = 0.25


def colour_of(owner):
    given = own_colours[owner] if owner < len(own_colours) else ""
    return tuple(int(given[i:i + 2], 16) / 255 for i in (1, 3, 5)) if given else body_palette[owner % len(body_palette)]


def lift(display, layer):
    """Later layers are nearer to the eye."""
    display.Position = [0, 0, 0.001 * size * layer]


def show_bodies(view):
    bodies, edges = parts_of(lines, "bodies", "link"), parts_of(lines, "outlines of bodies", "link")
    bodies.UpdatePipeline(wanted)
    if is_empty(bodies):
        return
    owners = sorted(cell_values(bodies, "owner"))
    table = GetColorTransferFunction("owner")
    table.InterpretValuesAsCategories = 1
    names = names_of(lines, "owners")
    table.Annotations = [text for owner in owners for text in (str(owner), names[owner])]
    table.IndexedColors = [channel for owner in owners for channel in colour_of(owner)]
    for source, representation, opacity, layer in ((bodies, "Surface", 0.35, 1), (edges, "Wireframe", 1, 2)):
        display = Show(source, view, "UnstructuredGridRepresentation")
        display.Representation = representation
        display.Opacity, display.LineWidth = opacity, 3
        ColorBy(display, ("CELLS", "owner"))
        lift(display, layer)
    display.SetScalarBarVisibility(view, len(owners) <= 20)
    style_bar(table, view, "")


def show_lines(source, view, colour, width, layer, representation="Wireframe"):
    display = Show(source, view, "UnstructuredGridRepresentation")
    display.Representation = representation
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = colour
    display.Ambient, display.Diffuse = 1, 0
    display.LineWidth = width
    lift(display, layer)


def show_arrows(arrows, view, name, colour):
    RenameSource(name, arrows)
    display = Show(arrows, view, "GeometryRepresentation")
    display.ColorArrayName = ["POINTS", ""]
    display.AmbientColor = display.DiffuseColor = colour
    display.Ambient, display.Diffuse = 1, 0
    display.LineWidth = 3
    lift(display, 9)


def show_forces(source, view, giver, colour):
    """Arrows, cut at three times the usual force."""
    vector = Calculator(Input=source, AttributeType="Point Data", ResultArrayName="arrow")
    vector.Function = f'"force [N]" * min(1, {3 * usual_force:.9g} / max(mag("force [N]"), {1e-9 * usual_force:.9g}))'
    RenameSource(f"{giver} forces", vector)
    arrows = Glyph(Input=vector, GlyphType="Arrow")
    arrows.OrientationArray = arrows.ScaleArray = ["POINTS", "arrow"]
    arrows.ScaleFactor = 0.2 * size / usual_force
    arrows.GlyphMode = "All Points"
    arrows.GlyphType.TipLength, arrows.GlyphType.TipRadius, arrows.GlyphType.ShaftRadius = 0.2, 0.06, 0.018
    show_arrows(arrows, view, f"{giver} arrows", colour)


def bent_arrow(way):
    """Three quarters of a circle with an arrowhead."""
    angles = [math.radians(a) for a in (*range(0, 271, 10), 238, 270, 238)]
    radii = [1] * 28 + [1.35, 1, 0.65]
    points = [(0.035 * size * r * math.cos(way * a), 0.035 * size * r * math.sin(way * a), 0) for a, r in zip(angles, radii)]
    return PolyLineSource(Points=[x for point in points for x in point])


def show_couples(source, view, giver, colour):
    """Bent arrows that show only the sense; couples under two hundredths of the largest are left out."""
    for way in (1, -1):
        some = between(source, ["POINTS", "couple [N m]"], *sorted((0.02 * way * largest_couple, way * largest_couple)))
        RenameSource(f"{giver} couples", some)
        arrows = GlyphWithCustomSource(Input=some)
        setattr(arrows, "GlyphSource" if hasattr(arrows, "GlyphSource") else "GlyphType", bent_arrow(way))
        arrows.OrientationArray, arrows.ScaleArray = ["POINTS", "No orientation array"], ["POINTS", "No scale array"]
        arrows.ScaleFactor = 1
        arrows.GlyphMode = "All Points"
        show_arrows(arrows, view, f"{giver} bent arrows", colour)


def write(view, text, colour, line):
    words = Text(Text=text)
    RenameSource(text, words)
    label = Show(words, view)
    label.Color, label.FontSize = colour, 16
    label.WindowLocation = "Any Location" if GetParaViewVersion() >= 5.10 else "AnyLocation"
    label.Position = [0.01, 0.01 + 0.03 * line]


def show_flexible(source, view, stress):
    display = Show(source, view, "UnstructuredGridRepresentation")
    ColorBy(display, ("POINTS", "von Mises [Pa]"))
    display.SetScalarBarVisibility(view, True)
    table = GetColorTransferFunction("von Mises [Pa]")
    table.RescaleTransferFunction(0, stress or 1)
    style_bar(table, view, "von Mises [Pa]")
    lift(display, 0)


def show_impacts(source, view):
    display = Show(source, view, "UnstructuredGridRepresentation")
    display.Representation = "Points"
    display.PointSize = 9
    display.RenderPointsAsSpheres = 1
    ColorBy(display, ("POINTS", "peak force [N]"))
    display.SetScalarBarVisibility(view, True)
    style_bar(GetColorTransferFunction("peak force [N]"), view, "impacts: peak force [N]")
    lift(display, 8)


def survey(moving, forces, times):
    """Over some times: the box of what moves (xmin, xmax, ymin, ymax), the usual force, the largest couple and stress, the kinds of forces."""
    box, largest, couple, stress, kinds = [1e300, -1e300, 1e300, -1e300], [], 0, 0, set()
    for time in times[:: max(1, len(times) // 25)]:
        for source in moving:
            source.UpdatePipeline(time)
            b = source.GetDataInformation().GetBounds()
            if b[0] <= b[1]:
                box = [min(box[0], b[0]), max(box[1], b[1]), min(box[2], b[2]), max(box[3], b[3])]
            if source.PointData.GetArray("von Mises [Pa]"):
                stress = max(stress, source.PointData["von Mises [Pa]"].GetRange(0)[1])
        forces.UpdatePipeline(time)
        if not is_empty(forces):
            largest.append(forces.PointData["force [N]"].GetRange(-1)[1])
            couple = max(couple, *(abs(x) for x in forces.PointData["couple [N m]"].GetRange(0)))
            kinds |= cell_values(forces, "part")
    return box, sorted(largest)[int(0.9 * (len(largest) - 1))] if largest else 0, couple, stress, {part_names[k] for k in kinds}


body_palette, arrow_palette, givers = BODY_PALETTE, ARROW_PALETTE, GIVERS
files, times = series()
readers = [reader(part) for part in files]
lines, others = readers[0], readers[1:]
part_names = names_of(lines, "parts")
own_colours = names_of(lines, "colours") if lines.FieldData.GetArray("colours") else []
view = GetActiveViewOrCreate("RenderView")
if len(sys.argv) > 1:
    view.ViewSize = [1400, 1000]
flexible = [source for source in others if source.FieldData.GetArray("body")]
drawn = {name: parts_of(lines, name, *parts) for name, parts in {
    "cylinders": ["cylinder"], "ground": ["hatch"], "guides": ["guide"], "joints": ["joint"], "journals": ["journal"],
    "bearings": ["bearing"], "springs": ["spring"]}.items()}
forces = parts_of(lines, "forces at points", "reaction", "contact force", "spring force", "load")
rigid = parts_of(lines, "what moves", "link")
box, usual_force, largest_couple, stress, kinds = survey([rigid, drawn["cylinders"], *flexible], forces, times)
size = max(box[1] - box[0], box[3] - box[2], 1e-9)

view.UseColorPaletteForBackground = 0
view.Background = [1, 1, 1]
view.OrientationAxesVisibility = 0
view.InteractionMode = "2D"
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
wanted = float(sys.argv[2]) if len(sys.argv) > 2 else times[-1] if len(sys.argv) > 1 else times[0]
ink, grey = [0.16, 0.18, 0.22], [0.55, 0.55, 0.6]
show_bodies(view)
show_lines(drawn["ground"], view, grey, 1.5, -1)
show_lines(drawn["guides"], view, grey, 3, -1)
show_lines(drawn["cylinders"], view, [0.3, 0.3, 0.35], 4, 3)
show_lines(drawn["springs"], view, [0.3, 0.3, 0.35], 2.5, 4)
for name in ("joints", "journals", "bearings"):
    show_lines(drawn[name], view, ink, 2.5, 5)
for source in flexible:
    show_flexible(source, view, stress)
for source in others:
    if source.PointData.GetArray("peak force [N]"):
        show_impacts(source, view)
    elif source not in flexible:
        show_lines(source, view, [0.6, 0.6, 0.65], 1.5, -0.5)
written = 0
for giver, part, colour in zip(givers, part_names[part_names.index("reaction"):], arrow_palette):
    own = parts_of(lines, f"{giver} forces at points", part)
    if usual_force > 0:
        show_forces(own, view, giver, colour)
    if largest_couple > 0:
        show_couples(own, view, giver, colour)
    if part in kinds:
        write(view, giver, colour, written)
        written += 1

time = AnnotateTimeFilter(Input=lines)
time.Format = "t = {time:.6g} s" if GetParaViewVersion() >= 5.10 else "t = %g s"
label = Show(time, view)
label.Color, label.FontSize = ink, 20
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
