"""The 3-D files of a run open in VTK's own reader and hold what they should.

Runs a tiny case on two ranks, reads every file of fields/ with vtkHDFReader, and checks dimensions, points, arrays and
the series index.
"""
import json
import math
import os
import subprocess
import sys
import tempfile

import numpy as np
from vtk import vtkHDFReader
from vtk.util.numpy_support import vtk_to_numpy

CASE = """
title = "vtk"
[channel]
size = ["10 um", "12 um", "9 um"]
shear_rate = "200 s-1"
[fluid]
viscosity = "1.2 mPa.s"
[numerics]
dx = "0.5 um"
[[cell]]
vertices = 642
count = 2
placement = "random"
[[carrier]]
count = 7
radius = "125 nm"
[magnetic]
B0 = "0.1 T"
[run]
steps = 20
[output]
fields = "0.0000681 s"
"""


def read(path):
    reader = vtkHDFReader()
    reader.SetFileName(path)
    assert reader.CanReadFile(path), path
    reader.Update()
    return reader.GetOutput()


def expect(name, measured, expected, tolerance=0.0):
    print(f"{name}: measured {measured} expected {expected} tolerance {tolerance}")
    assert abs(measured - expected) <= tolerance, name


def main(binary):
    with tempfile.TemporaryDirectory() as directory:
        case = os.path.join(directory, "case.toml")
        with open(case, "w", encoding="utf-8") as file:
            file.write(CASE)
        out = os.path.join(directory, "out")
        subprocess.run(["mpirun", "-np", "2", binary, "run", case, "--out", out], check=True, stdout=subprocess.DEVNULL)
        fields = os.path.join(out, "fields")

        with open(os.path.join(fields, "fluid.vtkhdf.series"), encoding="utf-8") as file:
            series = json.load(file)["files"]
        expect("snapshots", len(series), 3)
        expect("time of the second", series[1]["time"], 6.81e-5, 1e-6)

        fluid = read(os.path.join(fields, series[0]["name"]))
        assert fluid.GetDimensions() == (20, 24, 18), fluid.GetDimensions()
        expect("spacing um", fluid.GetSpacing()[0], 0.5)
        expect("first node um", fluid.GetOrigin()[2], 0.25)
        velocity = vtk_to_numpy(fluid.GetPointData().GetArray("velocity_m_per_s")).reshape(18, 24, 20, 3)
        expect("velocity of the top nodes m/s", velocity[-1, 0, 0, 1], 200 * 8.75e-6, 2e-5)
        density = vtk_to_numpy(fluid.GetPointData().GetArray("density"))
        expect("mean density", float(np.mean(density)), 1.0, 1e-5)

        cells = read(os.path.join(fields, "cells_00000.vtkhdf"))
        expect("triangles", cells.GetNumberOfCells(), 2 * 1280)
        points = vtk_to_numpy(cells.GetPoints().GetData())
        ids = vtk_to_numpy(cells.GetCellData().GetArray("cell_id"))
        assert set(ids) == {1.0, 2.0}
        area = 0.0
        volume = 0.0
        for k in range(cells.GetNumberOfCells()):
            a, b, c = (points[cells.GetCell(k).GetPointId(j)] for j in range(3))
            area += 0.5 * np.linalg.norm(np.cross(b - a, c - a))
            volume += np.dot(a, np.cross(b, c)) / 6
            assert max(math.dist(a, b), math.dist(b, c), math.dist(c, a)) < 1.0, "a cell is torn"
        expect("area of two cells um2", area, 2 * 134.1, 0.01 * 2 * 134.1)
        expect("volume of two cells um3", volume, 2 * 94.1, 0.001 * 2 * 94.1)

        carriers = read(os.path.join(fields, "carriers_00002.vtkhdf"))
        expect("carriers", carriers.GetNumberOfPoints(), 7)
        at = vtk_to_numpy(carriers.GetPoints().GetData())
        assert at.min() >= 0 and at[:, 2].max() <= 9, at
        speed = vtk_to_numpy(carriers.GetPointData().GetArray("velocity_m_per_s"))
        assert np.isfinite(speed).all() and 0 < speed[:, 1].max() < 200 * 9e-6
        assert sorted(vtk_to_numpy(carriers.GetPointData().GetArray("carrier_id"))) == list(range(1285, 1292))
    print("1 passed, 0 failed")


if __name__ == "__main__":
    main(sys.argv[1])
