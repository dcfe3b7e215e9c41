# SPDX-License-Identifier: GPL-3.0-or-later
"""Scan, ScanFile and what is made without a registration: values, files, bytes."""

import copy
import multiprocessing
import pickle
import struct
import zlib

import numpy as np
import pytest
from conftest import cases
from hypothesis import given, strategies as st

import crude_registration as cr


@pytest.fixture(scope="module", params=["pairs", "trihedra"])
def scan(request, views):
    return cr.Scan(views[0].image, method=request.param)


def test_a_scan_says_what_it_is(views):
    scan = cr.Scan(views[0].image)
    assert 0 < scan.number_of_samples <= len(views[0].image.points)
    assert scan.points.shape == scan.normals.shape and scan.points.dtype == np.float64
    assert np.allclose(np.linalg.norm(scan.normals, axis=1), 1)
    assert scan.has_free_space and 0 < scan.spacing < scan.extent
    assert "samples" in repr(scan) and "free space known" in repr(scan)
    low, high = views[0].image.points.min(axis=0) - scan.spacing, views[0].image.points.max(axis=0) + scan.spacing
    assert (scan.points > low).all() and (scan.points < high).all()
    assert scan.normals[:, 2].mean() > 0  # towards the sensor, which looks along -z


def test_units_do_not_matter(views):
    scan, larger = cr.Scan(views[0].image.points * 1024), cr.Scan(views[0].image.points)
    assert scan.spacing == larger.spacing * 1024
    assert np.allclose(scan.points, larger.points * 1024)


def test_files_are_read_as_they_were_written(views, tmp_path):
    image = views[0].image
    image.write(tmp_path / "image.ply")
    again = cr.read_scan(tmp_path / "image.ply")
    assert again.kind is cr.ScanKind.RANGE_IMAGE
    assert np.array_equal(again.points, image.points) and np.array_equal(again.grid, image.grid)
    assert np.array_equal(again.viewing_direction, image.viewing_direction) and again.viewpoint is None
    assert again.faces is None
    assert cr.Scan(again).to_bytes() == cr.Scan(image).to_bytes() == cr.Scan(str(tmp_path / "image.ply")).to_bytes()
    perspective, _ = cr.simulate(cr.make_statue(24), (1, 0, 0), samples=40, perspective=True)
    assert np.array_equal(perspective.viewpoint, [0, 0, 0]) and perspective.viewing_direction is None
    assert repr(perspective).endswith("in a grid of 40 rows and 40 columns>")


def test_what_a_file_says_is_told(views, tmp_path):
    points = views[0].image.points
    rows = "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in points.tolist())
    head = "\n".join(
        (
            "VERSION .7",
            "FIELDS x y z",
            "SIZE 8 8 8",
            "TYPE F F F",
            "COUNT 1 1 1",
            f"WIDTH {len(points) + 1}",
            "HEIGHT 1",
            "VIEWPOINT 0 0 5 1 0 0 0",
            f"POINTS {len(points) + 1}",
            "DATA ascii",
        )
    )
    (tmp_path / "cloud.pcd").write_text(f"{head}\n{rows}nan nan nan\n", encoding="ascii")
    file = cr.read_scan(tmp_path / "cloud.pcd")
    assert file.kind is cr.ScanKind.POINTS and file.missing == 1 and isinstance(file.notes, list)
    assert np.array_equal(file.viewpoint, [0, 0, 5]) and np.array_equal(file.points, points)
    # The sensor that a file names is that of the scan, unless another one is given.
    expected = cr.Scan(points, viewpoint=(0, 0, 5)).to_bytes()
    assert cr.Scan(file).to_bytes() == cr.Scan(tmp_path / "cloud.pcd").to_bytes() == expected
    assert cr.Scan(file, viewpoint=(0, 0, 6)).to_bytes() == cr.Scan(points, viewpoint=(0, 0, 6)).to_bytes()
    np.save(tmp_path / "cloud.npy", points)
    assert cr.Scan(tmp_path / "cloud.npy", viewpoint=(0, 0, 5)).to_bytes() == expected


def write_depths(path, depths):
    """A PNG file of one channel of 16 bits."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = b"".join(b"\0" + row.tobytes() for row in depths.astype(">u2"))
    head = struct.pack(">IIBBBBB", depths.shape[1], depths.shape[0], 16, 0, 0, 0, 0)
    parts = chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + parts)


def test_depth_images_are_read_with_their_camera(tmp_path):
    v, u = np.mgrid[0:40, 0:60]
    depths = (1500 + 200 * np.sin(u / 9) + 150 * np.cos(v / 7)).astype(int)
    depths[3, 5] = depths[20:22, 30] = 0
    write_depths(tmp_path / "depth.png", depths)
    camera = cr.DepthCamera(fx=50.0, fy=55.0, cx=29.5, cy=19.5, scale=1000.0)
    try:
        image = cr.read_scan(tmp_path / "depth.png", camera=camera)
    except OSError as e:
        if "libpng" in str(e):
            pytest.skip("the module was built without libpng")
        raise
    assert image.kind is cr.ScanKind.RANGE_IMAGE and image.grid.shape == (40, 60) and image.missing == 3
    assert np.array_equal(image.viewpoint, [0, 0, 0])
    z = depths[depths > 0] / 1000
    expected = np.stack([(u[depths > 0] - 29.5) * z / 50, (v[depths > 0] - 19.5) * z / 55, z], axis=1)
    assert np.allclose(image.points, expected, rtol=1e-14) and (image.grid >= 0).sum() == len(z)
    assert np.array_equal(cr.read_scan(tmp_path / "depth.png", camera=np.array(camera)).points, image.points)
    scan = cr.Scan(image)
    assert scan.has_free_space and cr.register(scan, scan).overlap > 0.9
    for wrong in (None, camera._replace(fx=0.0), camera._replace(scale=float("nan"))):
        with pytest.raises(OSError, match="depth.png: a depth image is read only with its camera"):
            cr.read_scan(tmp_path / "depth.png", camera=wrong)
    with pytest.raises(OSError, match="camera"):
        cr.Scan(tmp_path / "depth.png")
    for wrong in ((1, 2, 3), np.eye(5)):
        with pytest.raises(ValueError, match="camera: five numbers are needed"):
            cr.read_scan(tmp_path / "depth.png", camera=wrong)
    with pytest.raises(TypeError, match="camera: the type of an array"):
        cr.read_scan(tmp_path / "depth.png", camera="camera.json")


def test_normals_of_a_file_are_told_and_used(views, tmp_path):
    points = views[0].image.points
    normals = np.tile([0.0, 0.0, 1.0], (len(points), 1))
    np.save(tmp_path / "cloud.npy", np.hstack([points, normals]))
    file = cr.read_scan(tmp_path / "cloud.npy")
    assert np.array_equal(file.points, points) and np.array_equal(file.normals, normals)
    assert views[0].image.normals is None
    assert cr.Scan(file).to_bytes() == cr.Scan(points, normals=normals).to_bytes() != cr.Scan(points).to_bytes()


def test_the_grid_is_that_of_the_points(views):
    image = views[0].image
    used = image.grid[image.grid >= 0]
    assert sorted(used) == list(range(len(image.points)))
    surface = image.surface()
    assert isinstance(surface, cr.Mesh) and surface.faces.max() < len(surface.points)


def test_simulation_is_the_truth(statue):
    image, T = cr.simulate(statue, (1, 2, -3), samples=60)
    assert np.allclose(T[:3, :3] @ T[:3, :3].T, np.eye(3)) and np.linalg.det(T[:3, :3]) > 0
    in_scene = image.points @ T[:3, :3].T + T[:3, 3]
    distance = np.linalg.norm(in_scene[:, None] - statue.points[None, ::4], axis=2).min(axis=1)
    assert distance.max() < 0.2
    again, _ = cr.simulate(statue, (1, 2, -3), samples=60)
    assert np.array_equal(again.points, image.points)
    for arguments, error in (
        ({"samples": 1}, "samples"),
        ({"noise": -1}, "noise"),
        ({"drop_out": 2}, "drop_out"),
        ({"samples": 20001}, "samples"),
    ):
        with pytest.raises(ValueError, match=error):
            cr.simulate(statue, (1, 0, 0), **arguments)
    with pytest.raises(ValueError, match="direction"):
        cr.simulate(statue, (0, 0, 0))
    with pytest.raises(ValueError, match="resolution"):
        cr.make_statue(7)


def test_simplification_leaves_what_was_asked_for(statue):
    few = cr.simplify(statue, number_of_vertices=300)
    assert len(few.points) == 300 and few.faces.max() == 299
    by_error = cr.simplify(statue, approximation_error=1e-5)
    assert 300 < len(by_error.points) < len(statue.points)
    assert len(cr.simplify(statue, approximation_error=1e-5, cell_size=0.05).points) < len(statue.points)
    with pytest.raises(ValueError, match="approximation_error"):
        cr.simplify(statue, approximation_error=-1)
    with pytest.raises(ValueError, match="cell_size"):
        cr.simplify(statue, cell_size=float("nan"))


def test_bytes_make_the_same_scan(scan, views):
    data = scan.to_bytes()
    again = cr.Scan.from_bytes(data)
    assert again.to_bytes() == data
    assert np.array_equal(again.points, scan.points) and np.array_equal(again.normals, scan.normals)
    assert (again.number_of_samples, again.spacing, again.extent, again.has_free_space) == (
        scan.number_of_samples,
        scan.spacing,
        scan.extent,
        scan.has_free_space,
    )
    for method in ("pairs", "trihedra"):
        other = cr.Scan(views[1].image, method="trihedra")
        try:
            expected = cr.register(scan, other, method=method).to_json()
        except ValueError as e:
            assert "not simplified" in str(e)
            with pytest.raises(ValueError, match="not simplified"):
                cr.register(again, other, method=method)
            continue
        assert cr.register(again, other, method=method).to_json() == expected


def test_scans_are_pickled_and_copied(scan):
    for copied in (pickle.loads(pickle.dumps(scan)), copy.deepcopy(scan), pickle.loads(pickle.dumps(scan, protocol=2))):
        assert copied.to_bytes() == scan.to_bytes()


def register_in_another_process(pair):
    return cr.register(*pair)


def test_scans_go_to_other_processes(views):
    scans = [cr.Scan(v.image) for v in views[:3]]
    pairs = [(scans[0], scans[1]), (scans[1], scans[2])]
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        answers = pool.map(register_in_another_process, pairs)
    assert [a.to_json() for a in answers] == [cr.register(*pair).to_json() for pair in pairs]


def test_scans_are_kept_in_files(scan, tmp_path):
    path = tmp_path / "scan.crs"
    scan.save(path)
    assert path.read_bytes() == scan.to_bytes()
    assert cr.Scan.load(path).to_bytes() == scan.to_bytes()
    path.write_bytes(scan.to_bytes()[:-1])
    with pytest.raises(OSError, match="scan.crs: .*cut off"):
        cr.Scan.load(path)
    with pytest.raises(FileNotFoundError):
        cr.Scan.load(tmp_path / "missing")


def with_checksum(data):
    return data + zlib.crc32(data).to_bytes(4, "little")


def test_the_bytes_are_as_documented(scan):
    data = scan.to_bytes()
    assert data[:8] == b"CRScan\r\n"
    version = int.from_bytes(data[8:12], "little")
    assert version == 5
    assert int.from_bytes(data[12:20], "little") == len(data) - 24
    assert data == with_checksum(data[:-4])
    assert data[20] == 1  # side
    rotation = np.frombuffer(data, "<f8", 9, 21).reshape(3, 3)
    assert np.allclose(rotation @ rotation.T, np.eye(3))
    other = with_checksum(data[:8] + (version + 1).to_bytes(4, "little") + data[12:-4])
    with pytest.raises(ValueError, match=f"the format is {version + 1}, not {version}"):
        cr.Scan.from_bytes(other)


@cases(300)
@given(st.data())
def test_cut_or_altered_bytes_are_an_error(data):
    good = small_scan().to_bytes()
    kind = data.draw(st.sampled_from(["cut", "longer", "altered", "altered, with checksum", "any", "empty"]))
    at = data.draw(st.integers(0, len(good) - 5))
    if kind == "cut":
        bad = good[:at]
    elif kind == "longer":
        bad = good + data.draw(st.binary(min_size=1, max_size=9))
    elif kind == "any":
        bad = data.draw(st.binary(max_size=60))
    elif kind == "empty":
        bad = b"CRScan\r\n"
    else:
        new = data.draw(st.binary(min_size=1, max_size=8))
        altered = good[: min(at, len(good) - 5)] + new + good[at + len(new) :]
        if altered[:-4] == good[:-4] or len(altered) != len(good):
            return
        bad = altered
        if kind == "altered, with checksum":
            # What nobody does by accident: a scan that is another one, or an error, but no crash.
            try:
                scan = cr.Scan.from_bytes(with_checksum(altered[:-4]))
            except ValueError:
                return
            try:
                cr.register(scan, small_scan(), time_budget=1)
            except ValueError:
                pass
            return
    with pytest.raises(ValueError, match="Scan.from_bytes: "):
        cr.Scan.from_bytes(bad)


_small = []


def small_scan():
    if not _small:
        _small.append(cr.Scan(cr.simulate(cr.make_statue(24), (1, 0, 0), samples=24)[0], method="trihedra"))
    return _small[0]
