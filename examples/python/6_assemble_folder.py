"""Puts all scans of a folder together: 6_assemble_folder.py [FOLDER]. Without a folder it makes six scans of a body."""

import pathlib
import sys
import tempfile

import numpy as np

import crude_registration as cr


def simulate_into(folder):
    statue = cr.make_statue(resolution=64)
    for i, angle in enumerate(np.radians(30 * np.arange(6))):
        image, _ = cr.simulate(statue, (-np.cos(angle), -np.sin(angle), -0.25), samples=150, noise=0.1)
        image.write(folder / f"scan_{i}.ply")


with tempfile.TemporaryDirectory() as temporary:
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else temporary)
    if len(sys.argv) == 1:
        simulate_into(folder)
    paths = sorted(folder.glob("*.ply"))
    result = cr.assemble(paths, progress=lambda share: print(f"{100 * share:.0f} %", file=sys.stderr))

print(result)
for path, scan in zip(paths, result.scans):
    print(path.name, "component", scan.component, scan.reason)
    print(scan.T_model_scan)  # maps the scan into the frame of the first one of its component
for edge in result.edges:
    print(paths[edge.source].name, "to", paths[edge.target].name, edge.status, f"{edge.confidence:.3f}")
assert result.number_of_components < len(paths)
