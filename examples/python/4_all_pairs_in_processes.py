"""Prepares each scan once and registers all pairs, in the processes of an executor: prepared scans are pickled."""

import itertools
import multiprocessing
from concurrent.futures import ProcessPoolExecutor

import numpy as np

import crude_registration as cr


def register(pair):
    return cr.register(*pair, parallel=False)


if __name__ == "__main__":
    statue = cr.make_statue(resolution=64)
    angles = np.radians(40 * np.arange(4))
    images = [cr.simulate(statue, (-np.cos(a), -np.sin(a), -0.25), samples=150)[0] for a in angles]
    # Processes of their own, not forks: a fork has no threads but one, and those of the parent may hold locks.
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(max_workers=2, mp_context=context) as executor:
        scans = list(executor.map(cr.Scan, [image.surface() for image in images]))
        pairs = list(itertools.combinations(range(len(scans)), 2))
        results = list(executor.map(register, [(scans[i], scans[j]) for i, j in pairs]))
    for (i, j), result in zip(pairs, results):
        print(i, "to", j, result)
    # Neighbours overlap enough.
    assert all(r.status is cr.RegistrationStatus.REGISTERED for (i, j), r in zip(pairs, results) if j == i + 1)
