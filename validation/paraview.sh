#!/bin/sh
# What a run leaves for ParaView, read by VTK's own reader: every file of the collection, its fields, its size and place.
#   sh validation/paraview.sh path/to/capsule
# Skipped (77) where Debian's python3-vtk9 is missing.
python=/usr/bin/python3
if ! $python -c 'import vtk' 2> /dev/null; then
  echo "skipped: needs the package python3-vtk9"
  exit 77
fi
. "$(dirname "$0")/lib/program.sh"
cat > case.toml << 'TOML'
accuracy = 1e-2
capsule.radius = 0.7
capsule.start_x = -2.5
membrane.law = "skalak"
membrane.bending_ratio = 1e-3
flow.capillary_number = 0.05
until.x_g = -1.5
output.profiles_at_x_g = [-2.2, -2]
TOML
"$capsule" run case.toml --out out > run.log 2>&1 || {
  cat run.log
  exit 1
}
"$capsule" run case.toml --out between --set until.x_g=-2.3 --set 'output.profiles_at_x_g=[]' \
  --set pore.shape=two-mouths --set pore.exit_x=6 > run.log 2>&1 || {
  cat run.log
  exit 1
}
$python - << 'PYTHON'
import math
import xml.etree.ElementTree
import vtk

files = [data.get("file") for data in xml.etree.ElementTree.parse("out/membrane.pvd").iter("DataSet")]
assert len(files) >= 3, files
for file in files:
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName("out/" + file)
    reader.Update()
    surface = reader.GetOutput()
    fields = surface.GetPointData()
    names = {fields.GetArrayName(i) for i in range(fields.GetNumberOfArrays())}
    assert names == {"stretch_meridional", "stretch_azimuthal", "tension_meridional", "tension_azimuthal"}, names
    assert 0.9 < fields.GetArray("stretch_meridional").GetRange()[0] <= fields.GetArray("stretch_meridional").GetRange()[1] < 1.2
    triangles = vtk.vtkTriangleFilter()
    triangles.SetInputData(surface)
    body = vtk.vtkMassProperties()
    body.SetInputConnection(triangles.GetOutputPort())
    volume, sphere = body.GetVolume(), 4 / 3 * math.pi * 0.7**3
    assert abs(volume / sphere - 1) < 0.01, (file, volume, sphere)  # of a polyhedron with 32 sides
    left, right = surface.GetBounds()[:2]
    assert -3.3 < left < right < -0.5, (left, right)
    print(f"{file}: {surface.GetNumberOfPoints()} points, volume {volume:.4f} of {sphere:.4f}")

# The wall of eq. 1, up to ten radii outside of its mouths; the end of a tube behind which the flow goes on is no mouth.
slope = math.tan(math.radians(78.5))
for directory, end in ("out", 15), ("between", 6):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(directory + "/wall.vtp")
    reader.Update()
    surface = reader.GetOutput()
    left, right = surface.GetBounds()[:2]
    last = end - left if directory == "between" else end
    assert abs(right - last) < 0.01 and left < -1.8, (directory, left, right)
    points = [surface.GetPoint(i) for i in range(surface.GetNumberOfPoints())]
    for x, y, z in points:
        outside = max(-x, x - end, 0)
        assert abs(math.hypot(y, z) - math.hypot(1, slope * outside)) < 1e-4, (directory, x, y, z)
    inside = [x for x, y, z in points if 0 <= x <= end]
    assert min(inside) < 0.3 and max(inside) > end - 0.3, (directory, min(inside), max(inside))
    print(f"{directory}/wall.vtp: from x = {left:.2f} to {right:.2f}")
PYTHON
