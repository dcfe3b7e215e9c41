"""Assembles scans by the processes of an executor, here of this machine: 8_executor.py [STORE]

Dask's workers and those of MPI are others of the same interface, on as many machines as there are:

    with distributed.Client("scheduler:8786") as client:
        result = cr.assemble(paths, executor=client.get_executor(), store=store)

    with mpi4py.futures.MPIPoolExecutor() as executor:  # mpirun -n 9 python3 -m mpi4py.futures program.py
        result = cr.assemble(paths, executor=executor, store=store)
"""

import multiprocessing
import pathlib
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor

import numpy as np

import crude_registration as cr

if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        statue = cr.make_statue(resolution=64)
        paths = [pathlib.Path(temporary) / f"scan_{i}.ply" for i in range(6)]
        for path, angle in zip(paths, np.radians(30 * np.arange(6))):
            cr.simulate(statue, (-np.cos(angle), -np.sin(angle), -0.25), samples=150)[0].write(path)
        # A folder that all workers see keeps the prepared scans and the answers: a run that was ended goes on.
        store = sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(temporary) / "store"
        # Processes of their own, not forks: a fork has no threads but one, and those of the parent may hold locks.
        with ProcessPoolExecutor(max_workers=2, mp_context=multiprocessing.get_context("spawn")) as executor:
            result = cr.assemble(paths, executor=executor, store=store)
        print(result)
        # The same bits, whoever works.
        alone = cr.assemble(paths)
        assert all(np.array_equal(a.T_model_scan, b.T_model_scan) for a, b in zip(result.scans, alone.scans))
