# SPDX-License-Identifier: GPL-3.0-or-later
"""A program that mypy --strict has to accept: what the stubs promise to who uses the module."""

import concurrent.futures
import pathlib
from typing import List, Optional, Tuple

import numpy
import numpy.typing

import crude_registration as cr

Floats = numpy.typing.NDArray[numpy.float64]


def say(share: float) -> Optional[bool]:
    print(share)
    return None


def use(
    points: Floats,
    faces: numpy.typing.NDArray[numpy.int32],
    path: pathlib.Path,
    executor: concurrent.futures.Executor,
) -> Tuple[Floats, float]:
    source = cr.Scan(points, faces, viewpoint=(0, 0, 1), progress=say)
    target = cr.Scan(path, method="trihedra")
    target = cr.Scan(points, normals=points)
    result = cr.register(source, target, time_budget=3.0, progress=say)
    result = cr.register(path, "target.ply", viewpoint=numpy.zeros(3))
    scaled = cr.register_with_scale(path, source, time_budget=3.0, progress=say)
    print(scaled.scale * scaled.scale_deviation, scaled.similarity @ scaled.registration.T_target_source)
    if result.status is cr.RegistrationStatus.REGISTERED:
        names: List[str] = result.free_motions
        print(names, result.poses[0].score, result.statistics[0].seconds)
    mesh = cr.simplify(cr.make_statue(), number_of_vertices=100)
    refined = cr.refine(mesh, cr.read_scan(path), result.T_target_source)
    if cr.judge(source, path, refined.T_target_source).status is cr.MotionStatus.RIGHT:
        print(cr.judge(source, path, numpy.eye(4)).refined.overlap)
    image, T_scene_scan = cr.simulate(mesh, [1.0, 0.0, 0.0])
    depths = cr.read_scan(path, camera=cr.DepthCamera(525, 525, 319.5, 239.5, 1000))
    depths = cr.read_scan(path, camera=(525, 525, 319.5, 239.5, 1000))
    if depths.normals is not None:
        print(depths.normals.shape)
    model = cr.assemble([source, path, points], executor=executor, store=path, progress=say)
    print(model.components, model.scans[0].T_model_scan, model.edges[0].status is cr.EdgeStatus.USED)
    grid = image.grid
    if grid is not None:
        print(grid.shape)
    cr.Scan.from_bytes(source.to_bytes()).save(path)
    return T_scene_scan @ refined.T_target_source, refined.residual


def misuse(path: pathlib.Path) -> None:
    # Each of these is an error of types: mypy --strict tells where one is not (an ignore that is not needed).
    cr.register(path)  # type: ignore[call-arg]
    cr.register(path, path, None)  # type: ignore[misc]
    cr.register(path, path, methods="pairs")  # type: ignore[call-arg]
    cr.Scan(path, progress=3)  # type: ignore[arg-type]
    cr.read_scan(path).kind = cr.ScanKind.MESH  # type: ignore[misc]
