"""Registers arrays: points as a depth camera, Open3D (numpy.asarray(cloud.points)) or trimesh (mesh.vertices, mesh.faces)
hold them."""

import numpy as np

import crude_registration as cr

statue = cr.make_statue()
views = [cr.simulate(statue, (-np.cos(a), -np.sin(a), -0.25), samples=200, perspective=True) for a in (0, 0.7)]
source, target = (image.points.astype(np.float32) for image, _ in views)

# Plain points of shape (n, 3), and where the sensor stood: of a camera's the origin of its frame.
result = cr.register(source, target, viewpoint=(0, 0, 0))
print("points:", result)
assert result.status is cr.RegistrationStatus.REGISTERED

# The same as an image of shape (rows, columns, 3), NaN where there is no sample.
images = []
for image, _ in views:
    grid = np.full(image.grid.shape + (3,), np.nan)
    grid[image.grid >= 0] = image.points[image.grid[image.grid >= 0]]
    images.append(grid)
result = cr.register(*images, viewpoint=(0, 0, 0))
print("images:", result)
assert result.status is cr.RegistrationStatus.REGISTERED

# A mesh: its vertices and its faces. All of the statue is there, and no sensor saw it.
model = cr.Scan(statue.points, statue.faces)
result = cr.register(images[0], model, source_viewpoint=(0, 0, 0))
print("to a model:", result)
assert result.status is cr.RegistrationStatus.REGISTERED
assert np.abs(result.T_target_source - views[0][1]).max() < 0.05  # the simulation says how the camera stood
