"""Draws one frame of a particle series with VTK, to look at it without ParaView.

usage: render.py SERIES.vtkhdf PICTURE.png [--frame N] [--field Velocity] [--clip x|y|z] [--size 1600x1000]

Particles are shaded spheres coloured by the magnitude of the field. `--clip` takes away the half in front of the
middle plane across that axis. The camera looks across the longest extent and shows the whole body. No window is
opened: VTK's wheel draws through EGL or OSMesa, whichever the machine has.
"""

import argparse
import sys

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 registers the drawing back end
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline as Pipeline
from vtkmodules.vtkIOHDF import vtkHDFReader
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkPolyDataMapper,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)

# Anchors of the viridis colour map (S. van der Walt and N. Smith, 2015, public domain).
VIRIDIS = [
    (0.267, 0.005, 0.329), (0.283, 0.141, 0.458), (0.254, 0.265, 0.530), (0.207, 0.372, 0.553),
    (0.164, 0.471, 0.558), (0.128, 0.567, 0.551), (0.135, 0.659, 0.518), (0.267, 0.749, 0.441),
    (0.478, 0.821, 0.318), (0.741, 0.873, 0.150), (0.993, 0.906, 0.144),
]


def main():
    options = parse()
    time, points, values, unit = read(options.series, options.frame, options.field)
    if options.clip:
        axis = "xyz".index(options.clip)
        behind = points[:, axis] <= points[:, axis].mean()
        points, values = points[behind], values[behind]
    window = draw(points, values, f"{options.field} [{unit}]" if unit else options.field, f"t = {time:.4g} s", options)
    shot = vtkWindowToImageFilter()
    shot.SetInput(window)
    shot.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetFileName(options.picture)
    writer.SetInputConnection(shot.GetOutputPort())
    writer.Write()
    print(f"{options.picture}: {len(points)} particles at {time:.4g} s, {values.min():.4g} to {values.max():.4g} {unit}")


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("series")
    parser.add_argument("picture")
    parser.add_argument("--frame", type=int, default=-1, help="index, negative counts from the end")
    parser.add_argument("--field", default="Velocity")
    parser.add_argument("--clip", choices=list("xyz"))
    parser.add_argument("--size", default="1600x1000")
    options = parser.parse_args()
    options.size = tuple(int(n) for n in options.size.split("x"))
    return options


def read(path, frame, field):
    reader = vtkHDFReader()
    reader.SetFileName(path)
    reader.UpdateInformation()
    times = reader.GetOutputInformation(0).Get(Pipeline.TIME_STEPS()) or [0.0]
    time = times[frame]
    reader.UpdateTimeStep(time)
    data = reader.GetOutputDataObject(0)
    array = data.GetPointData().GetArray(field)
    if array is None:
        names = [data.GetPointData().GetArrayName(i) for i in range(data.GetPointData().GetNumberOfArrays())]
        sys.exit(f"{path} has no field {field}; it has {', '.join(names)}")
    values = vtk_to_numpy(array).astype(float)
    if values.ndim == 2:
        values = np.linalg.norm(values, axis=1)
    unit = {"Velocity": "m/s", "Pressure": "Pa", "Density": "kg/m^3", "WSS": "Pa", "VonMises": "Pa"}.get(field, "")
    return time, vtk_to_numpy(data.GetPoints().GetData()).astype(float), values, unit


def draw(points, values, title, subtitle, options):
    spacing = typical_spacing(points)
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    anchors = np.array(VIRIDIS)
    places = np.linspace(0, len(anchors) - 1, 256)
    for i, place in enumerate(places):
        rgb = [np.interp(place, np.arange(len(anchors)), anchors[:, c]) for c in range(3)]
        table.SetTableValue(i, *rgb, 1.0)
    low = 0.0 if options.field in ("Velocity", "WSS") else values.min()
    table.SetTableRange(low, max(values.max(), low + 1e-12))

    body = vtkPolyData()
    coordinates = vtkPoints()
    coordinates.SetData(numpy_to_vtk(points, deep=True))
    body.SetPoints(coordinates)
    scalars = numpy_to_vtk(values, deep=True)
    scalars.SetName("shown")
    body.GetPointData().SetScalars(scalars)
    cell = vtkCellArray()
    cell.InsertNextCell(len(points))
    for i in range(len(points)):
        cell.InsertCellPoint(i)
    body.SetVerts(cell)
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(body)
    mapper.SetLookupTable(table)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().RenderPointsAsSpheresOn()

    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(title)
    bar.SetNumberOfLabels(5)
    bar.SetVerticalTitleSeparation(16)
    bar.SetMaximumWidthInPixels(90)
    bar.SetPosition(0.88, 0.2)
    bar.SetPosition2(0.1, 0.6)
    for style in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        style.SetColor(0.1, 0.1, 0.1)
        style.ItalicOff()
        style.BoldOff()
        style.ShadowOff()
    note = vtkTextActor()
    note.SetInput(subtitle)
    note.SetPosition(24, 20)
    note.GetTextProperty().SetColor(0.1, 0.1, 0.1)
    note.GetTextProperty().SetFontSize(24)

    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    for prop in (actor, bar, note):
        renderer.AddViewProp(prop)
    place_camera(renderer, points, spacing, options)
    pixels = options.size[1] / (2 * renderer.GetActiveCamera().GetParallelScale())
    actor.GetProperty().SetPointSize(max(1.0, 1.5 * spacing * pixels))

    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*options.size)
    window.AddRenderer(renderer)
    window.Render()
    return window


def typical_spacing(points):
    """Median distance to the nearest particle, over a sample."""
    sample = points[:: max(1, len(points) // 400)]
    nearest = []
    for point in sample:
        distance = np.linalg.norm(points - point, axis=1)
        nearest.append(np.partition(distance, 1)[1] if len(points) > 1 else 1.0)
    return float(np.median(nearest))


def place_camera(renderer, points, spacing, options):
    """Looks along the axis of least extent (or of the clip), the longest extent lying across the picture."""
    low, high = points.min(axis=0), points.max(axis=0)
    extent = high - low
    view = "xyz".index(options.clip) if options.clip else int(np.argmin(extent))
    across = max((axis for axis in range(3) if axis != view), key=lambda axis: extent[axis])
    up = 3 - view - across
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    centre = (low + high) / 2
    position = centre.copy()
    position[view] += 2 * np.linalg.norm(extent)
    # A little tilt tells front from back; the clipped face is looked at squarely enough to be read.
    position[up] += 0.35 * np.linalg.norm(extent)
    direction = np.zeros(3)
    direction[up] = 1
    camera.SetFocalPoint(*centre)
    camera.SetPosition(*position)
    camera.SetViewUp(*direction)
    width, height = options.size
    needed = max(1.3 * extent[across] * height / width, 1.3 * (extent[up] + 0.2 * extent[view]))
    camera.SetParallelScale(0.5 * needed + 2 * spacing)
    # The colour bar stands at the right.
    camera.SetWindowCenter(0.14, 0.0)
    renderer.ResetCameraClippingRange()


if __name__ == "__main__":
    main()
