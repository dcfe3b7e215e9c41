"""Registers points with normals, as Open3D's PointCloud (cloud.points, cloud.normals) holds them: normals tell from which
side a surface was seen where nobody knows where the sensor stood."""

import numpy as np

import crude_registration as cr

statue = cr.make_statue()
scans = []
for angle in (0, 0.7):
    direction = (-np.cos(angle), -np.sin(angle), -0.25)
    image, T_scene_scan = cr.simulate(statue, direction, samples=200)
    mesh = image.surface()
    # Of each vertex the mean of the normals of the faces around it, as most programs compute them; their length is free.
    corners = mesh.points[mesh.faces]
    of_faces = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals = np.zeros_like(mesh.points)
    for k in range(3):
        np.add.at(normals, mesh.faces[:, k], of_faces)
    scans.append((cr.Scan(mesh.points, normals=normals), T_scene_scan))

(source, T_scene_source), (target, T_scene_target) = scans
result = cr.register(source, target)
print(result)
assert result.status is cr.RegistrationStatus.REGISTERED
truth = np.linalg.inv(T_scene_target) @ T_scene_source
assert np.abs(result.T_target_source - truth).max() < 0.05  # the simulation says how the scanner stood
