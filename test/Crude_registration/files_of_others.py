#!/usr/bin/env python3
# Files that other programs wrote are read as they wrote them: files_of_others.py PROGRAM FOLDER. Open3D writes PLY, PCD
# and glTF files, PCL's tools write PCD and PLY files; what is missing is passed over, and where both are the exit code
# is 77.
import pathlib
import shutil
import subprocess
import sys

try:
    import numpy
except ImportError:
    sys.exit(77)
try:
    import open3d
except ImportError:
    open3d = None

program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
# A curved surface, its normals, away from the origin, of numbers that floats do not hold.
u, v = (a.ravel() for a in numpy.meshgrid(numpy.linspace(-1, 1, 40), numpy.linspace(-1, 1, 30)))
points = numpy.stack([u + 0.1, v - 3.7, 0.3 * numpy.sin(2 * u) * v + 1 / 3], axis=1)
normals = numpy.stack([-0.6 * numpy.cos(2 * u) * v, -0.3 * numpy.sin(2 * u), numpy.ones_like(u)], axis=1)
normals /= numpy.linalg.norm(normals, axis=1, keepdims=True)
failures, checked = [], []


def check(name, tolerance):
    """The points of a file, as the program reads them, are those that were written, in their order."""
    output = folder / (name + ".npy")
    run = subprocess.run([program, "convert", str(folder / name), str(output)], capture_output=True, text=True)
    checked.append(name)
    if run.returncode != 0:
        failures.append(name + ": " + run.stderr.strip())
        return
    read = numpy.load(output)
    if read.shape[0] != len(points) or read.shape[1] not in (3, 6):
        failures.append(f"{name}: an array of {read.shape}")
        return
    if abs(read[:, :3] - points).max() > tolerance:
        failures.append(f"{name}: points are off by {abs(read[:, :3] - points).max()}")
    if read.shape[1] == 6 and abs(read[:, 3:] - normals).max() > 1e-5:
        failures.append(f"{name}: normals are off by {abs(read[:, 3:] - normals).max()}")


def tool(*arguments):
    if shutil.which(arguments[0]) is None:
        return False
    run = subprocess.run(arguments, cwd=folder, capture_output=True, text=True)
    if run.returncode != 0:
        failures.append(" ".join(arguments) + ": " + run.stdout + run.stderr)
    return run.returncode == 0


# Half a unit in the last place of numbers below eight: of doubles, of floats, and of text with six digits.
as_double, as_float, as_text = 2.0 ** -50, 2.0 ** -21, 0.5e-5
if open3d is not None:
    cloud = open3d.geometry.PointCloud(open3d.utility.Vector3dVector(points))
    cloud.normals = open3d.utility.Vector3dVector(normals)
    cloud.colors = open3d.utility.Vector3dVector(numpy.full_like(points, 0.5))
    for name, options, tolerance in [("o3d_text.ply", {"write_ascii": True}, as_text), ("o3d.ply", {}, as_double),
                                     ("o3d_text.pcd", {"write_ascii": True}, as_float), ("o3d.pcd", {}, as_float),
                                     ("o3d_packed.pcd", {"compressed": True}, as_float),
                                     ("o3d.xyz", {}, as_text)]:
        if open3d.io.write_point_cloud(str(folder / name), cloud, **options):
            check(name, tolerance)
        else:
            failures.append(name + " is not written")

    # A mesh in binary glTF, as floats: what the program writes of it has the vertices in their order.
    columns, rows = 40, 30
    corner = numpy.arange(columns * rows).reshape(rows, columns)
    a, b, c, d = corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]
    triangles = numpy.concatenate([numpy.stack(t, axis=-1).reshape(-1, 3) for t in [(a, b, c), (a, c, d)]])
    mesh = open3d.geometry.TriangleMesh(open3d.utility.Vector3dVector(points), open3d.utility.Vector3iVector(triangles))
    mesh.vertex_normals = open3d.utility.Vector3dVector(normals)
    mesh.vertex_colors = open3d.utility.Vector3dVector(numpy.full_like(points, 0.5))
    for name in ["o3d.glb", "o3d.gltf"]:
        if open3d.io.write_triangle_mesh(str(folder / name), mesh):
            check(name, as_float)
        else:
            failures.append(name + " is not written")

# For PCL's tools: what they read is text, plain enough.
with open(folder / "plain.pcd", "w") as out:
    out.write("# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n"
              f"WIDTH {len(points)}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {len(points)}\nDATA ascii\n")
    for p in points:
        out.write("%.9g %.9g %.9g\n" % tuple(p))
for kind, name in [("0", "pcl_text.pcd"), ("1", "pcl.pcd"), ("2", "pcl_packed.pcd")]:
    if tool("pcl_convert_pcd_ascii_binary", "plain.pcd", name, kind):
        check(name, as_text if kind == "0" else as_float)
for kind, name in [("0", "pcl_text.ply"), ("1", "pcl.ply")]:
    if tool("pcl_pcd2ply", "-format", kind, "-use_camera", "0", "plain.pcd", name):
        check(name, as_text)

print("read: " + (", ".join(checked) or "nothing"))
for failure in failures:
    print("failed: " + failure)
sys.exit(1 if failures else 0 if checked else 77)
