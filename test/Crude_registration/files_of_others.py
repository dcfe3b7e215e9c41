#!/usr/bin/env python3
# Files that other programs wrote are read as they wrote them: files_of_others.py PROGRAM FOLDER.
#
# NumPy writes arrays and text, packed or not; Open3D points and meshes of all kinds, and the camera of a depth image;
# Pillow that image; PCL's tools PCD and PLY; assimp and CloudCompare meshes and text; laspy LAS. What is missing is
# passed over; without NumPy the exit code is 77.
import os
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
try:
    import PIL.Image
except ImportError:
    PIL = None
try:
    import laspy
except ImportError:
    laspy = None

program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
# A curved surface, its normals, away from the origin, of numbers that floats do not hold.
u, v = (a.ravel() for a in numpy.meshgrid(numpy.linspace(-1, 1, 40), numpy.linspace(-1, 1, 30)))
points = numpy.stack([u + 0.1, v - 3.7, 0.3 * numpy.sin(2 * u) * v + 1 / 3], axis=1)
normals = numpy.stack([-0.6 * numpy.cos(2 * u) * v, -0.3 * numpy.sin(2 * u), numpy.ones_like(u)], axis=1)
normals /= numpy.linalg.norm(normals, axis=1, keepdims=True)
failures, checked = [], []


def check(name, tolerance, points=points, in_order=True, turn=1e-5):
    """The points of a file, as the program reads them, are those that were written; in their order, but those of a
    soup of triangles."""
    output = folder / (name + ".read.npy")
    run = subprocess.run([program, "convert", str(folder / name), str(output)], capture_output=True, text=True)
    checked.append(name)
    if run.returncode != 0:
        failures.append(name + ": " + run.stderr.strip())
        return
    read = numpy.load(output)
    if read.ndim == 3:  # a range image, in which what is missing is NaN
        read = read.reshape(-1, 3)[~numpy.isnan(read).any(axis=2).ravel()]
    if not in_order:  # by rows of the grid, which are apart
        read = read[numpy.lexsort([read[:, 0], read[:, 1].round(3)])]
    if read.shape[0] != len(points) or read.shape[1] not in (3, 6):
        failures.append(f"{name}: an array of {read.shape}")
        return
    if abs(read[:, :3] - points).max() > tolerance:
        failures.append(f"{name}: points are off by {abs(read[:, :3] - points).max()}")
    if read.shape[1] == 6 and abs(read[:, 3:] - normals).max() > turn:
        failures.append(f"{name}: normals are off by {abs(read[:, 3:] - normals).max()}")


def tool(*arguments):
    if shutil.which(arguments[0]) is None:
        return False
    run = subprocess.run(arguments, cwd=folder, capture_output=True, text=True,
                         env={**os.environ, "QT_QPA_PLATFORM": "offscreen"})
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
                                     ("o3d.xyz", {}, as_text), ("o3d.xyzn", {}, as_text),
                                     ("o3d.xyzrgb", {}, as_text), ("o3d.pts", {"write_ascii": True}, as_text)]:
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
    mesh.compute_triangle_normals()  # which STL has
    mesh.vertex_normals = open3d.utility.Vector3dVector(normals)
    mesh.vertex_colors = open3d.utility.Vector3dVector(numpy.full_like(points, 0.5))
    for name, tolerance in [("o3d.glb", as_float), ("o3d.gltf", as_float), ("o3d_mesh.ply", as_double),
                            ("o3d.obj", as_text), ("o3d.off", as_text), ("o3d.stl", as_float)]:
        if open3d.io.write_triangle_mesh(str(folder / name), mesh):
            check(name, tolerance, in_order=not name.endswith("stl"))
        else:
            failures.append(name + " is not written")

# Arrays, whose normals are known as such by their length, and what NumPy writes as text.
both = numpy.concatenate([points, normals], axis=1)
for name, array, tolerance in [("f8.npy", points, 0), ("f4.npy", points.astype("f4"), as_float),
                               ("big_endian.npy", both.astype(">f8"), 0),
                               ("by_columns.npy", numpy.asfortranarray(both), 0),
                               ("image.npy", points.reshape(30, 40, 3), 0)]:
    numpy.save(folder / name, array)
    check(name, tolerance)
for name, options in [("plain.xyz", {}), ("packed.xyz.gz", {}), ("fixed.asc", {"fmt": "%.9f"}),
                      ("normals.csv", {"delimiter": ",", "header": "x,y,z,nx,ny,nz"})]:
    numpy.savetxt(folder / name, both, **options)
    check(name, 1e-9 if name == "fixed.asc" else as_double)

# A depth image with its camera beside it, as Open3D writes that: a millimetre is one.
if PIL is not None and open3d is not None:
    columns, rows = 64, 48
    fx, fy, cx, cy = 70.25, 69.5, 31.3, 23.9
    column, row = (a.ravel() for a in numpy.meshgrid(numpy.arange(columns), numpy.arange(rows)))
    depth = (900 + 7 * column + 300 * numpy.sin(row / 9)).astype(numpy.uint16)
    depth[(column + row) % 5 == 0] = 0
    PIL.Image.fromarray(depth.reshape(rows, columns)).save(folder / "depth.png")
    camera = open3d.camera.PinholeCameraIntrinsic(columns, rows, fx, fy, cx, cy)
    open3d.io.write_pinhole_camera_intrinsic(str(folder / "depth.json"), camera)
    z = depth[depth > 0] / 1000
    seen = numpy.stack([(column[depth > 0] - cx) / fx * z, (row[depth > 0] - cy) / fy * z, z], axis=1)
    check("depth.png", 1e-12, points=seen)

# LAS has whole numbers: half of its unit.
if laspy is not None:
    for version, kind in [("1.2", 3), ("1.4", 6)]:
        header = laspy.LasHeader(point_format=kind, version=version)
        header.offsets, header.scales = numpy.array([500000, 5000000, 100]), numpy.full(3, 1e-4)
        far = points + header.offsets
        las = laspy.LasData(header)
        las.x, las.y, las.z = far.T
        las.write(str(folder / f"las_{version}.las"))
        check(f"las_{version}.las", 0.51e-4, points=far)

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

# A mesh for assimp and CloudCompare: faces of numbers with nine digits.
with open(folder / "plain.off", "w") as out:
    out.write(f"OFF\n{len(points)} {2 * 39 * 29} 0\n")
    for p in points:
        out.write("%.9g %.9g %.9g\n" % tuple(p))
    for j in range(29):
        for i in range(39):
            a = 40 * j + i
            out.write(f"3 {a} {a + 1} {a + 41}\n3 {a} {a + 41} {a + 40}\n")
for kind, name, tolerance in [("stl", "assimp_text.stl", as_text), ("stlb", "assimp.stl", as_float),
                              ("obj", "assimp.obj", as_text), ("ply", "assimp_text.ply", as_text),
                              ("plyb", "assimp.ply", as_float), ("glb2", "assimp.glb", as_float),
                              ("gltf2", "assimp.gltf", as_float)]:
    if tool("assimp", "export", "plain.off", name, "-f" + kind):
        check(name, tolerance, in_order=False)
for kind, option, ending, tolerance in [("M", "OBJ", "obj", as_text), ("M", "STL", "stl", as_float),
                                        ("M", "PLY", "ply", as_float), ("M", "OFF", "off", as_text),
                                        ("C", "ASC", "asc", as_text), ("C", "PLY", "ply", as_float)]:
    name = f"cloudcompare_{kind.lower()}.{ending}"
    save = [f"-{kind}_EXPORT_FMT", option, "-SAVE_MESHES" if kind == "M" else "-SAVE_CLOUDS", "FILE", name]
    source = "plain.off" if kind == "M" else "plain.xyz"
    if tool("CloudCompare", "-SILENT", "-NO_TIMESTAMP", "-AUTO_SAVE", "OFF", "-O", source, *save):
        check(name, tolerance, in_order=False, turn=2e-3)  # it keeps normals in two bytes

print("read: " + (", ".join(checked) or "nothing"))
for failure in failures:
    print("failed: " + failure)
sys.exit(1 if failures else 0 if checked else 77)
