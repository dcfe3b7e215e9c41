"""Registers two simulated scans, and draws them before and after: 2_picture.py [PICTURE]"""

import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

import crude_registration as cr

statue = cr.make_statue()
source, _ = cr.simulate(statue, (-1, 0, -0.25), samples=200, noise=0.1)
target, _ = cr.simulate(statue, (-0.7, -0.7, -0.25), samples=200, noise=0.1)
result = cr.register(source, target)
print(result)
assert result.status is cr.RegistrationStatus.REGISTERED

R, t = result.T_target_source[:3, :3], result.T_target_source[:3, 3]
figure, axes = plt.subplots(1, 2, subplot_kw={"projection": "3d"}, figsize=(10, 5))
for axis, title, points in zip(axes, ("as scanned", "registered"), (source.points, source.points @ R.T + t)):
    axis.set_title(title)
    axis.scatter(*points[::5].T, s=0.5)
    axis.scatter(*target.points[::5].T, s=0.5)
    axis.set_aspect("equal")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "registered.png", dpi=150)
