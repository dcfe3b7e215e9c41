# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of any shape, type and layout: a right answer or an exception, never a crash, nothing misread."""

import array
import pathlib

import numpy as np
import pytest
from conftest import cases
from hypothesis import given, strategies as st
from hypothesis.extra import numpy as hnp

import crude_registration as cr

ERRORS = (ValueError, TypeError)


@pytest.fixture(scope="module")
def mesh(statue):
    return statue


@pytest.fixture(scope="module")
def expected(mesh):
    return cr.Scan(mesh.points, mesh.faces).to_bytes()


def layouts(points):
    """The same numbers, in memory otherwise."""
    wide = np.zeros((len(points), 7), points.dtype)
    wide[:, 1:6:2] = points
    backwards = np.ascontiguousarray(points[::-1])
    frozen = points.copy()
    frozen.flags.writeable = False
    shifted = np.zeros(points.nbytes + 1, np.uint8)[1:].view(points.dtype).reshape(points.shape)
    shifted[:] = points
    yield "columns", np.asfortranarray(points)
    yield "strides", wide[:, 1:6:2]
    yield "backwards", backwards[::-1]
    yield "read only", frozen
    yield "unaligned", shifted
    yield "big-endian", points.astype(points.dtype.newbyteorder(">"))
    yield "matrix", points.view(np.matrix)
    yield "buffer", memoryview(np.ascontiguousarray(points))
    yield "list", points.tolist()

    class Wrapped:
        def __array__(self, dtype=None):
            return points

    yield "__array__", Wrapped()


def test_layouts_give_the_same_scan(mesh, expected):
    for name, points in layouts(mesh.points):
        assert cr.Scan(points, mesh.faces).to_bytes() == expected, name
    for kind in (np.int8, np.uint16, np.int64, np.uint64, ">i4"):
        if np.iinfo(kind).max >= mesh.faces.max():
            assert cr.Scan(mesh.points, mesh.faces.astype(kind)).to_bytes() == expected, kind
    unaligned = np.zeros(mesh.faces.size * 8 + 1, np.uint8)[1:].view(np.int64).reshape(mesh.faces.shape)
    unaligned[:] = mesh.faces
    assert cr.Scan(mesh.points, unaligned).to_bytes() == expected
    assert cr.Scan(mesh).to_bytes() == expected
    assert cr.Scan(mesh.points, np.asfortranarray(mesh.faces)).to_bytes() == expected
    assert cr.Scan(mesh.points, mesh.faces.tolist()).to_bytes() == expected


def test_floats_are_taken_exactly(mesh):
    single = mesh.points.astype(np.float32)
    assert cr.Scan(single, mesh.faces).to_bytes() == cr.Scan(single.astype(np.float64), mesh.faces).to_bytes()
    flat = array.array("f", single.ravel())
    assert cr.Scan(np.frombuffer(flat, np.float32).reshape(-1, 3), mesh.faces).to_bytes() == cr.Scan(
        single, mesh.faces
    ).to_bytes()


def test_what_is_passed_may_change_later(mesh, expected):
    points, faces = mesh.points.copy(), mesh.faces.copy()
    scan = cr.Scan(points, faces)
    points[:] = np.nan
    faces[:] = 0
    assert scan.to_bytes() == expected
    assert np.isfinite(mesh.points).all()


def test_wrong_types_are_named(mesh):
    for wrong, error in (
        (mesh.points.astype(np.int64), "float32 or float64, not int64"),
        (mesh.points.astype(np.float16), "not float16"),
        (mesh.points.astype(np.longdouble), "float32 or float64, not"),
        (mesh.points.astype(complex), "not complex128"),
        (mesh.points.astype(object), "not object"),
        (mesh.points > 0, "not bool"),
        (None, "it is None"),
        (object(), "not object"),
        ({"points": 1}, "not object"),
        (np.array([("a", 1.0)], dtype=[("name", "U1"), ("x", float)]), "not"),
        (np.ma.masked_invalid(mesh.points), "masked"),
    ):
        with pytest.raises(TypeError, match=error):
            cr.Scan(wrong)
        with pytest.raises(TypeError, match=error):
            cr.register(wrong, mesh)
    with pytest.raises(TypeError, match="integer type, not float64"):
        cr.Scan(mesh.points, mesh.faces.astype(float))
    with pytest.raises(TypeError, match="integer type, not bool"):
        cr.Scan(mesh.points, mesh.faces > 0)


def test_wrong_shapes_are_named(mesh):
    for shape in ((3,), (3, 2), (3, 4), (2, 3, 4), (1, 1, 1, 3), (0,), ()):
        with pytest.raises(ValueError, match=r"\(n, 3\) or \(rows, columns, 3\) is needed, not \("):
            cr.Scan(np.zeros(shape))
    for shape in ((3,), (3, 2), (4, 3, 3)):
        with pytest.raises(ValueError, match=r"\(m, 3\) is needed, not \("):
            cr.Scan(mesh.points, np.zeros(shape, int))
    with pytest.raises(ValueError, match=r"\(n, 3\) is needed, not \(2, 2, 3\)"):
        cr.Scan(np.zeros((2, 2, 3)), np.zeros((1, 3), int))
    for index in (-1, len(mesh.points), 2**40, -(2**63)):
        faces = mesh.faces.astype(np.int64)
        faces[7, 1] = index
        with pytest.raises(ValueError, match=f"row 7 holds the index {index}, but there are {len(mesh.points)} points"):
            cr.Scan(mesh.points, faces)
    with pytest.raises(ValueError, match="faces are given with what has its own"):
        cr.Scan(mesh, mesh.faces)


def test_normals_tell_the_side(views):
    mesh = views[0].image.surface()
    towards = np.tile([0.0, 0.0, 1.0], (len(mesh.points), 1))  # to the sensor, which looks along -z
    facing, away = cr.Scan(mesh.points, normals=towards), cr.Scan(mesh.points, normals=-towards)
    assert (facing.normals[:, 2] > 0).mean() > 0.95 and (away.normals[:, 2] < 0).mean() > 0.95
    assert facing.to_bytes() != away.to_bytes() != cr.Scan(mesh.points).to_bytes()
    # The directions of normals are those of the points; their length says nothing, nor does their layout.
    for same in (1024 * towards, towards.astype(np.float32), np.asfortranarray(towards), towards.tolist(), towards[::-1]):
        assert cr.Scan(mesh.points, normals=same).to_bytes() == facing.to_bytes()
    some = towards.copy()
    some[::3] = 0
    assert (cr.Scan(mesh.points, normals=some).normals[:, 2] > 0).mean() > 0.95
    # The sensor knows better.
    assert cr.Scan(mesh.points, normals=-towards, viewpoint=(0, 0, 9)).normals[:, 2].mean() > 0


def test_wrong_normals_are_named(mesh):
    normals = np.ones_like(mesh.points)
    for wrong, error in (
        (normals[1:], rf"normals: an array of shape \({len(normals)}, 3\) is needed, as of the points, not \("),
        (normals[:, :2], r"normals: an array of shape"),
        (normals.ravel(), r"normals: an array of shape"),
        (np.where(np.arange(len(normals))[:, None] == 5, np.nan, normals), "normal 5 .* not finite"),
    ):
        with pytest.raises(ValueError, match=error):
            cr.Scan(mesh.points, normals=wrong)
    with pytest.raises(TypeError, match="normals: the type of an array has to be float32 or float64, not int64"):
        cr.Scan(mesh.points, normals=normals.astype(np.int64))
    for arguments in ((mesh,), (mesh.points, mesh.faces), ("scan.ply",)):
        with pytest.raises(ValueError, match="normals go with an array of points"):
            cr.Scan(*arguments, normals=normals)
    with pytest.raises(ValueError, match=r"\(n, 3\) is needed, not \(2, 2, 3\)"):
        cr.Scan(np.zeros((2, 2, 3)), normals=np.zeros((4, 3)))


def test_numbers_that_are_not_finite(mesh):
    for value in (np.nan, np.inf, -np.inf):
        points = mesh.points.copy()
        points[5, 1] = value
        with pytest.raises(ValueError, match="not finite"):
            cr.Scan(points)
        with pytest.raises(ValueError, match="not finite"):
            cr.Scan(points, mesh.faces)
    grid = np.zeros((3, 3, 3))
    grid[1, 1, 1] = np.inf
    with pytest.raises(ValueError, match="NaN or infinite"):
        cr.Scan(grid)
    for name in ("viewpoint", "viewing_direction"):
        with pytest.raises(ValueError, match=f"{name} is.* not finite"):
            cr.Scan(mesh, **{name: (0, 0, np.nan)})


def test_faces_that_are_no_manifold_become_one(mesh, expected):
    turned = mesh.faces.copy()
    turned[::2] = turned[::2, ::-1]
    assert cr.Scan(mesh.points, turned).number_of_samples > 0
    twice = np.vstack([mesh.faces, mesh.faces[:10], [[0, 0, 1]]])
    assert cr.Scan(mesh.points, twice).number_of_samples > 0
    lonely = np.vstack([mesh.points, [[9, 9, 9]]])
    assert cr.Scan(lonely, mesh.faces).to_bytes() == expected
    with pytest.raises(ValueError, match="no faces"):
        cr.Scan(mesh.points, np.zeros((0, 3), int))


def test_names_of_files(tmp_path):
    for name in ("missing.ply", pathlib.Path("missing.ply"), b"missing.ply", b"missing\xff.ply"):
        with pytest.raises(FileNotFoundError, match="missing.*: the file cannot be opened"):
            cr.read_scan(name)
        with pytest.raises(FileNotFoundError):
            cr.register(name, name)
    for name in ("x\0y", b"\0"):
        with pytest.raises(ValueError, match="null character"):
            cr.read_scan(name)
    for name in (3, None, np.zeros((3, 3))):
        with pytest.raises(TypeError, match="name of a file"):
            cr.read_scan(name)
    (tmp_path / "bad.off").write_text("OFF\n1 0 0\n0 0 x\n")
    with pytest.raises(OSError, match="bad.off:3: "):
        cr.read_scan(tmp_path / "bad.off")
    with pytest.raises(OSError, match="cannot be"):
        cr.read_scan(tmp_path)
    with pytest.raises(OSError, match="cannot be written"):
        cr.simulate(cr.make_statue(16), (1, 0, 0), samples=20)[0].write(tmp_path)


shapes = st.one_of(
    st.tuples(st.integers(0, 40), st.just(3)),
    st.tuples(st.integers(0, 9), st.integers(0, 9), st.just(3)),
    hnp.array_shapes(min_dims=0, max_dims=4, max_side=6),
)
kinds = st.one_of(
    st.sampled_from(["<f4", "<f8", ">f4", ">f8"]).map(np.dtype), hnp.scalar_dtypes(), hnp.array_dtypes(max_size=2)
)
numbers = st.one_of(
    st.integers(-4, 4).map(float), st.floats(width=32), st.sampled_from([0.0, 2.0**-100, 2.0**100, np.nan, np.inf])
)
float_arrays = hnp.arrays(st.sampled_from(["<f4", "<f8", ">f8"]).map(np.dtype), shapes, elements=numbers)
sides = st.one_of(st.none(), st.lists(st.one_of(st.floats(), st.integers(-5, 5)), min_size=0, max_size=4))


@cases(400)
@given(st.one_of(hnp.arrays(kinds, shapes), float_arrays), sides, st.sampled_from(["pairs", "trihedra"]))
def test_any_array_is_a_scan_or_an_error(points, viewpoint, method):
    try:
        scan = cr.Scan(points, viewpoint=viewpoint, method=method)
    except ERRORS:
        return
    assert points.dtype.kind == "f" and points.shape[-1] == 3
    assert 0 < scan.number_of_samples
    assert np.isfinite(scan.points).all() and np.isfinite(scan.normals).all()
    assert cr.Scan(np.asfortranarray(points.astype(float)), viewpoint=viewpoint, method=method).to_bytes() == scan.to_bytes()


@cases(400)
@given(
    hnp.arrays(np.float64, st.tuples(st.integers(0, 12), st.just(3)), elements=st.integers(-3, 3).map(float)),
    hnp.arrays(
        st.sampled_from([np.int8, np.uint8, np.int32, np.int64, np.uint64]),
        st.tuples(st.integers(0, 20), st.just(3)),
        elements=st.integers(0, 12),
    ),
)
def test_any_faces_are_a_scan_or_an_error(points, faces):
    try:
        scan = cr.Scan(points, faces)
    except ERRORS:
        return
    assert faces.size == 0 or faces.max() < len(points)
    assert scan.number_of_samples > 0


@cases(200)
@given(float_arrays, st.one_of(hnp.arrays(kinds, shapes), float_arrays, st.none()), sides)
def test_any_normals_are_a_scan_or_an_error(points, normals, viewpoint):
    try:
        scan = cr.Scan(points, normals=normals, viewpoint=viewpoint)
    except ERRORS:
        return
    assert normals is None or normals.shape == points.shape
    assert np.allclose(np.linalg.norm(scan.normals, axis=1), 1)


@cases(60)
@given(float_arrays, float_arrays, st.sampled_from(["pairs", "trihedra"]), st.booleans())
def test_any_two_arrays_are_registered_or_an_error(source, target, method, parallel):
    try:
        result = cr.register(source, target, method=method, parallel=parallel, time_budget=5)
    except ERRORS:
        return
    m = result.T_target_source
    assert np.allclose(m[:3, :3] @ m[:3, :3].T, np.eye(3), atol=1e-6)
    assert np.isfinite(m).all() and 0 <= result.confidence <= 1
    if result.status is not cr.RegistrationStatus.REGISTERED:
        assert result.reason


@cases(100)
@given(st.data())
def test_any_arguments_of_the_tools_are_an_answer_or_an_error(data):
    anything = st.one_of(float_arrays, st.none(), st.integers(), st.floats(), st.text(max_size=3), st.binary(max_size=3))
    x, y, z = data.draw(anything), data.draw(anything), data.draw(anything)
    for call in (
        lambda: cr.simplify(x, number_of_vertices=data.draw(st.integers(-3, 30)), cell_size=data.draw(st.floats())),
        lambda: cr.refine(x, y, z),
        lambda: cr.simulate(x, y, samples=data.draw(st.integers(-3, 30)), noise=data.draw(st.floats())),
        lambda: cr.Scan.from_bytes(z),
        lambda: cr.register(x, y, viewpoint=z, time_budget=1),
        lambda: cr.register_with_scale(x, y, viewpoint=z, time_budget=1),
    ):
        try:
            call()
        except (*ERRORS, OSError):
            pass
