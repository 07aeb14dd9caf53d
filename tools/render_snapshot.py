#!/usr/bin/env python3
"""Render one snapshot of a run directory: cells red, carriers blue, the flow on the far side, the lower plate grey.

    render_snapshot.py RUN_DIRECTORY NUMBER PICTURE.png

Needs python3-vtk9 and a display; without one: xvfb-run -a tools/render_snapshot.py ...
"""
import sys

import vtk


def read(path):
    reader = vtk.vtkHDFReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def actor(port, color):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(port)
    mapper.ScalarVisibilityOff()
    shape = vtk.vtkActor()
    shape.SetMapper(mapper)
    shape.GetProperty().SetColor(*color)
    return shape


def cells(grid):
    surface = vtk.vtkGeometryFilter()
    surface.SetInputData(grid)
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputConnection(surface.GetOutputPort())
    return actor(normals.GetOutputPort(), (0.75, 0.12, 0.12))


def carriers(grid):
    sphere = vtk.vtkSphereSource()
    sphere.SetRadius(0.25)  # twice life size, to be seen
    sphere.SetThetaResolution(16)
    sphere.SetPhiResolution(16)
    glyphs = vtk.vtkGlyph3D()
    glyphs.SetInputData(grid)
    glyphs.SetSourceConnection(sphere.GetOutputPort())
    glyphs.ScalingOff()
    return actor(glyphs.GetOutputPort(), (0.1, 0.2, 0.8))


def flow(image):
    extent = image.GetExtent()
    side = vtk.vtkExtractVOI()
    side.SetInputData(image)
    side.SetVOI(extent[0], extent[0], *extent[2:])
    side.Update()
    colors = vtk.vtkLookupTable()
    colors.SetHueRange(0.6, 0.1)
    colors.SetSaturationRange(0.35, 0.35)
    colors.SetVectorModeToComponent()
    colors.SetVectorComponent(1)
    colors.SetRange(*image.GetPointData().GetArray("velocity_m_per_s").GetRange(1))
    colors.Build()
    mapper = vtk.vtkDataSetMapper()
    mapper.SetInputConnection(side.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray("velocity_m_per_s")
    mapper.SetLookupTable(colors)
    mapper.SetUseLookupTableScalarRange(True)
    wall = vtk.vtkActor()
    wall.SetMapper(mapper)
    wall.GetProperty().SetLighting(False)
    return wall


def plate(bounds):
    source = vtk.vtkPlaneSource()
    source.SetOrigin(0, 0, 0)
    source.SetPoint1(bounds[1], 0, 0)
    source.SetPoint2(0, bounds[3], 0)
    shape = actor(source.GetOutputPort(), (0.8, 0.8, 0.8))
    shape.GetProperty().SetLighting(False)
    return shape


def main(directory, number, picture):
    fields = f"{directory}/fields"
    number = f"{int(number):05d}"
    image = read(f"{fields}/fluid_{number}.vtkhdf")
    bounds = image.GetBounds()
    scene = vtk.vtkRenderer()
    scene.SetBackground(1, 1, 1)
    for thing in (cells(read(f"{fields}/cells_{number}.vtkhdf")), carriers(read(f"{fields}/carriers_{number}.vtkhdf")),
                  flow(image), plate(bounds)):
        scene.AddActor(thing)
    camera = scene.GetActiveCamera()
    camera.SetFocalPoint(bounds[1] / 2, bounds[3] / 2, 0.45 * bounds[5])
    camera.SetPosition(3.2 * bounds[1], -0.42 * bounds[3], 1.5 * bounds[5])
    camera.SetViewUp(0, 0, 1)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetSize(900, 600)
    window.SetMultiSamples(8)
    window.AddRenderer(scene)
    scene.ResetCameraClippingRange()
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(picture)
    writer.SetInputConnection(grab.GetOutputPort())
    writer.Write()


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
