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
PYTHON
