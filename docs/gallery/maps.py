#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The Asperity authors
# SPDX-License-Identifier: MIT
"""maps.py EXPORT PICTURE.png: maps of `asperity export --to vtk`, drawn by VTK (PyPI): the block's lowest layer as
it is bent, coloured by pressure, raised above the substrate, coloured by height. Heights are drawn three times as
large as widths.

    ./asperity run scenes/first-contact.toml --set drive.path=relax surface.sites=96 --out results/maps
    ./asperity export results/maps --to vtk
    python3 docs/gallery/maps.py results/maps/export docs/gallery/maps.png
"""

import sys

import vtk


def sheet(file, array, lift, low, high, component=None):
    """A map as a surface: raised by its third component or itself, coloured by `array`."""
    reader = vtk.vtkXMLImageDataReader()
    reader.SetFileName(f"{sys.argv[1]}/{file}.vti")
    surface = vtk.vtkImageDataGeometryFilter()
    surface.SetInputConnection(reader.GetOutputPort())
    raised = vtk.vtkWarpVector() if component else vtk.vtkWarpScalar()
    raised.SetInputConnection(surface.GetOutputPort())
    raised.SetInputArrayToProcess(0, 0, 0, vtk.vtkDataObject.FIELD_ASSOCIATION_POINTS, component or array)
    raised.SetScaleFactor(1.0)
    smooth = vtk.vtkPolyDataNormals()
    smooth.SetInputConnection(raised.GetOutputPort())
    smooth.SplittingOff()
    colours = vtk.vtkColorTransferFunction()
    for value, rgb in zip((low, 0.5 * (low + high), high), ((0.0, 0.45, 0.70), (0.96, 0.96, 0.96), (0.84, 0.37, 0.0))):
        colours.AddRGBPoint(value, *rgb)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(smooth.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(array)
    mapper.SetLookupTable(colours)
    mapper.UseLookupTableScalarRangeOn()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.SetScale(1, 1, 3)
    actor.SetPosition(0, 0, lift)
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(colours)
    bar.SetTitle({"height (Å)": "height, A", "pressure (GPa)": "pressure, GPa"}[array])
    bar.SetNumberOfLabels(3)
    bar.SetVerticalTitleSeparation(8)
    bar.SetPosition(0.88, 0.55 if lift else 0.05)
    bar.SetHeight(0.4)
    bar.SetWidth(0.08)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0, 0, 0)
        text.ShadowOff()
        text.ItalicOff()
    return actor, bar


scene = vtk.vtkRenderer()
scene.SetBackground(1, 1, 1)
for actor, bar in (sheet("substrate", "height (Å)", 0, -5, 5),
                   sheet("relaxed", "pressure (GPa)", 110, -8, 8, "displacement (Å)")):
    scene.AddActor(actor)
    scene.AddViewProp(bar)
window = vtk.vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetMultiSamples(8)
window.SetSize(640, 440)
window.AddRenderer(scene)
camera = scene.GetActiveCamera()
camera.SetPosition(-1.0, -1.6, 0.9)
camera.SetFocalPoint(0, 0, 0)
camera.SetViewUp(0, 0, 1)
scene.ResetCamera()
camera.Zoom(1.2)
window.Render()
picture = vtk.vtkWindowToImageFilter()
picture.SetInput(window)
writer = vtk.vtkPNGWriter()
writer.SetFileName(sys.argv[2])
writer.SetInputConnection(picture.GetOutputPort())
writer.Write()
