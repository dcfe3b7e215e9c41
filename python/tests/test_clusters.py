# SPDX-License-Identifier: GPL-3.0-or-later
"""assemble() by processes that other packages run: Dask, of whose workers one is killed, and MPI."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys

import pytest
from conftest import bits

import crude_registration as cr


@pytest.fixture(scope="module")
def alone(files):
    return bits(cr.assemble(files))


@pytest.mark.parametrize("with_store", [False, True])
def test_dask_gives_the_tasks_of_a_dead_worker_to_others(alone, files, tmp_path, with_store):
    distributed = pytest.importorskip("distributed")
    with distributed.LocalCluster(
        n_workers=3, threads_per_worker=1, processes=True, dashboard_address=None, local_directory=tmp_path / "dask"
    ) as cluster, distributed.Client(cluster) as client:
        pids = client.run(os.getpid)
        assert len(set(pids.values())) == 3 and os.getpid() not in pids.values()
        killed = []

        def kill_one(share):
            busy = [worker for worker, tasks in client.processing().items() if tasks and worker in pids]
            if busy and not killed:
                killed.append(busy[0])
                os.kill(pids[busy[0]], signal.SIGKILL)

        store = tmp_path / "store" if with_store else None
        result = cr.assemble(files, executor=client.get_executor(), store=store, progress=kill_one)
        assert killed and killed[0] not in client.run(os.getpid)
        assert bits(result) == alone


def test_mpi(alone, files, tmp_path):
    pytest.importorskip("mpi4py")
    if not shutil.which("mpirun"):
        pytest.skip("there is no mpirun")
    # Of Open MPI: also as root, also with more processes than processors.
    environment = {"ALLOW_RUN_AS_ROOT": "1", "ALLOW_RUN_AS_ROOT_CONFIRM": "1", "MCA_rmaps_base_oversubscribe": "1"}
    program = pathlib.Path(__file__).with_name("assemble_by_mpi.py")
    done = subprocess.run(
        ["mpirun", "-n", "3", sys.executable, "-m", "mpi4py.futures", program, tmp_path, *files],
        env={**os.environ, **{f"OMPI_{name}": value for name, value in environment.items()}},
        check=False,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    for name in ("without_store", "with_store"):
        assert (tmp_path / name).read_text(encoding="ascii") == alone
