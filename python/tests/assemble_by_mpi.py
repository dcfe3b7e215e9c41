# SPDX-License-Identifier: GPL-3.0-or-later
"""Assembles scans by the processes of MPI: mpirun -n 3 python3 -m mpi4py.futures assemble_by_mpi.py FOLDER SCAN..."""

import os
import pathlib
import sys

from conftest import bits
from mpi4py.futures import MPIPoolExecutor

import crude_registration as cr

if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1])
    with MPIPoolExecutor() as executor:
        workers = {executor.submit(os.getpid).result() for _ in range(20)}
        assert os.getpid() not in workers
        for name, store in (("without_store", None), ("with_store", folder / "store")):
            result = cr.assemble(sys.argv[2:], executor=executor, store=store)
            (folder / name).write_text(bits(result), encoding="ascii")
