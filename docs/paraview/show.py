"""Shows a run in ParaView: speed of the blood on slices beside the wall by its shear stress, both over time.

From a terminal, with ParaView 5.12 or later, whose reader knows VTKHDF series of PolyData:

    pvpython docs/paraview/show.py OUT [--time SECONDS] [--picture FILE.png]

In ParaView: open `fluid.vtkhdf` and, where there is one, `wall.vtkhdf`, press Apply, and run this file as a macro (Macros, Import new
macro) or by Run Script of the Python shell. It takes the sources that are open.
"""

import argparse
import os

from paraview import servermanager
from paraview.simple import *  # noqa: F403 the names of ParaView are made at run time

# Planes across the vessel, as parts of its length, besides the one along it.
ACROSS = [0.2, 0.4, 0.6, 0.8]
# Reach of the mean over particles on a plane, in their distance from each other.
REACH = 1.6
# What colours the wall: the first that it has.
ON_WALL = ["WSS", "TAWSS", "VonMises", "Displacement"]


def arrays(source):
    data = source.PointData
    return [data[k].Name for k in range(len(data))]


def opened(folder):
    """The blood and the wall of a folder, or of what is open in ParaView."""
    if folder is not None:
        sources = []
        for name in ["fluid.vtkhdf", "wall.vtkhdf"]:
            path = os.path.join(folder, name)
            sources.append(OpenDataFile(path) if os.path.exists(path) else None)
        return sources
    found = [source for source in GetSources().values() if hasattr(source, "PointData")]
    blood = [source for source in found if "Density" in arrays(source) or "Id" in arrays(source)]
    wall = [source for source in found if source not in blood and set(arrays(source)) & set(ON_WALL)]
    return [next(iter(blood), None), next(iter(wall), None)]


def extent(source):
    """Middle of the particles, their main axes from the longest on, the ends along the first, and their distance from each other."""
    import numpy as np
    from vtkmodules.util.numpy_support import vtk_to_numpy

    points = vtk_to_numpy(servermanager.Fetch(source).GetPoints().GetData()).astype(float)
    middle = points.mean(axis=0)
    _, axes = np.linalg.eigh(np.cov((points - middle).T))
    axes = axes.T[::-1]
    along = (points - middle) @ axes[0]
    some = points[:: max(1, len(points) // 200)]
    apart = [np.partition(((points - x) ** 2).sum(axis=1), 1)[1] ** 0.5 for x in some]
    return middle, axes, (along.min(), along.max()), float(np.median(apart))


def slices(blood):
    """Speed on planes, as a mean over the particles around, and nothing where there are none."""
    middle, axes, (low, high), apart = extent(blood)
    speed = Calculator(Input=blood, ResultArrayName="Speed", Function="mag(Velocity)")
    planes = [(middle, axes[2])]
    planes += [(middle + (low + part * (high - low)) * axes[0], axes[0]) for part in ACROSS]
    made = []
    for center, normal in planes:
        plane = PointPlaneInterpolator(Input=speed, Source="Bounded Plane")
        plane.Source.BoundingBox = list(blood.GetDataInformation().GetBounds())
        plane.Source.Center = list(center)
        plane.Source.Normal = list(normal)
        plane.Source.Resolution = 400
        plane.Kernel = "GaussianKernel"
        plane.Kernel.Radius = REACH * apart
        plane.Kernel.Sharpness = 2.0
        plane.NullPointsStrategy = "Mask Points"
        plane.ValidPointsMaskArrayName = "Valid"
        made.append(Threshold(Input=plane, Scalars=["POINTS", "Valid"], LowerThreshold=0.5, UpperThreshold=1.5, AllScalars=1))
    return made


def colour(shown, view, array, title):
    ColorBy(shown, ("POINTS", array, "Magnitude"))
    # Planes share their colours: each widens the range.
    shown.RescaleTransferFunctionToDataRange(True, False)
    table = GetColorTransferFunction(array)
    table.ApplyPreset("Viridis (matplotlib)", True)
    bar = GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    bar.TitleFontSize, bar.LabelFontSize, bar.ScalarBarLength = 14, 12, 0.3
    bar.TitleColor = bar.LabelColor = [0.1, 0.1, 0.1]
    bar.WindowLocation = "Upper Right Corner"
    shown.SetScalarBarVisibility(view, True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", nargs="?", help="output folder of a run; what is open in ParaView without it")
    parser.add_argument("--time", type=float, help="time to show [s], the last otherwise")
    parser.add_argument("--picture", help="file for a picture")
    options, _ = parser.parse_known_args()
    blood, wall = opened(options.out)
    if blood is None:
        raise SystemExit("there is no fluid.vtkhdf: name the folder, or open the file first")
    times = list(blood.TimestepValues) or [0.0]
    time = min(times, key=lambda t: abs(t - options.time)) if options.time is not None else times[-1]
    blood.UpdatePipeline(time)

    layout = CreateLayout("vaso")
    view = CreateRenderView()
    AssignViewToLayout(view=view, layout=layout, hint=0)
    for plane in slices(blood):
        colour(Show(plane, view), view, "Speed", "speed [m/s]")
    views = [view]
    if wall is not None:
        wall.UpdatePipeline(time)
        ghost = Show(wall, view)
        ghost.ColorArrayName = [None, ""]
        ghost.Opacity = 0.12
        beside = CreateRenderView()
        AssignViewToLayout(view=beside, layout=layout, hint=1)
        shown = Show(wall, beside)
        field = next((name for name in ON_WALL if name in arrays(wall)), None)
        if field:
            colour(shown, beside, field, {"WSS": "WSS [Pa]", "TAWSS": "TAWSS [Pa]"}.get(field, field))
        AddCameraLink(view, beside, "vaso")
        views.append(beside)
    GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    _, axes, _, _ = extent(blood)
    for each in views:
        each.ViewTime = time
        each.CameraParallelProjection = 1
        each.CameraViewUp = list(axes[1])
        each.CameraFocalPoint = [0, 0, 0]
        # From aside, so that the planes across are seen.
        each.CameraPosition = list(axes[2] + 0.6 * axes[0] + 0.35 * axes[1])
        each.UseColorPaletteForBackground = 0
        each.Background = [1, 1, 1]
        ResetCamera(each)
        Render(each)
    if options.picture:
        SaveScreenshot(options.picture, layout, ImageResolution=[1600, 800])


main()
