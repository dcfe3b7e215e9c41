#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints a table of the executors of assemble(): the seconds that generated scans take with one to four workers, and what
happens when one of three workers is killed in the middle. The exit code is 1 where an answer has other bits.

PYTHONPATH=build/python benchmark/python/executors.py [--scans 100] [--executors processes,dask,mpi] [--workers 1,2,3,4]

Each run is a process of its own with a store of its own. Seconds are those of assemble(): the start of the workers is not
in them, as they serve many runs. Processor seconds are those of all its processes, from their start to their end. Of
several repetitions the one with the least seconds is printed, as others may use the machine.
"""

import argparse
import contextlib
import hashlib
import importlib.util
import json
import math
import multiprocessing
import os
import pathlib
import platform
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import crude_registration as cr

MODULES = {"processes": "concurrent.futures", "dask": "distributed", "mpi": "mpi4py"}
NAMES = {"processes": "`ProcessPoolExecutor`", "dask": "Dask, `LocalCluster`", "mpi": "mpi4py, `MPIPoolExecutor`"}


def simulate_scans(folder, number, samples):
    """Views from all around a body."""
    statue = cr.make_statue(resolution=64)
    golden = math.pi * (3 - math.sqrt(5))  # the angle that spreads directions evenly
    for i in range(number):
        height = 1.2 * (i + 0.5) / number - 0.6
        angle = golden * i
        direction = (-math.cos(angle), -math.sin(angle), height)
        cr.simulate(statue, direction, samples=samples, noise=0.1, seed=i)[0].write(folder / f"scan_{i:03}.ply")


def digest(result):
    """Of all of an answer but its times: the same for the same bits."""
    scans = [(s.component, s.T_model_scan.tobytes(), s.reason, s.residual, s.covariance.tobytes()) for s in result.scans]
    return hashlib.sha256(repr((scans, result.edges, result.overlaps)).encode()).hexdigest()


@contextlib.contextmanager
def executor_of(kind, workers, folder):
    """An executor whose workers have begun, and a function that tells their process numbers."""
    if kind == "none":
        yield None, lambda: []
    elif kind == "processes":
        from concurrent.futures import ProcessPoolExecutor

        with ProcessPoolExecutor(workers, mp_context=multiprocessing.get_context("spawn")) as executor:
            list(executor.map(time.sleep, [0.5] * workers))
            yield executor, lambda: list(executor._processes)
    elif kind == "dask":
        import distributed

        with distributed.LocalCluster(
            workers, threads_per_worker=1, dashboard_address=None, local_directory=folder
        ) as cluster, distributed.Client(cluster) as client:
            pids = client.run(os.getpid)
            yield client.get_executor(), lambda: list(pids.values())
    else:
        from mpi4py.futures import MPIPoolExecutor

        with MPIPoolExecutor() as executor:
            executor.bootup()
            pids = {executor.submit(os.getpid).result() for _ in range(20)}
            yield executor, lambda: list(pids)


def run_one(arguments):
    """In a process of its own: prints what came of it."""
    store = pathlib.Path(arguments.store)
    killed = []

    with executor_of(arguments.run, arguments.count, arguments.folder) as (executor, pids):

        def progress(share):
            if arguments.kill_after and not killed and len(list(store.glob("*.pair"))) >= arguments.kill_after:
                killed.append(pids()[0])
                os.kill(killed[0], signal.SIGKILL)

        paths = sorted(pathlib.Path(arguments.folder).glob("*.ply"))
        begin = time.monotonic()
        answer = {}
        try:
            if executor is None:
                result = cr.assemble(paths, store=store, parallel=arguments.count > 1, progress=progress)
            else:
                result = cr.assemble(paths, executor=executor, store=store, progress=progress)
            answer["digest"] = digest(result)
            answer["components"] = result.number_of_components
        except Exception as e:
            answer["error"] = type(e).__name__
        answer["seconds"] = time.monotonic() - begin
        answer["killed"] = len(killed)
        print("answer:", json.dumps(answer), flush=True)


def run(folder, kind, workers, store, kill_after=0):
    command = [sys.executable]
    if kind == "mpi":
        command = ["mpirun", "-n", str(workers + 1), sys.executable, "-m", "mpi4py.futures"]
    command += [__file__, "--folder", str(folder), "--run", kind, "--count", str(workers), "--store", str(store)]
    # Of Open MPI: also as root, also with more processes than processors.
    options = {"ALLOW_RUN_AS_ROOT": "1", "ALLOW_RUN_AS_ROOT_CONFIRM": "1", "MCA_rmaps_base_oversubscribe": "1"}
    environment = {**os.environ, **{f"OMPI_{name}": value for name, value in options.items()}}
    store.mkdir(exist_ok=True)
    load = os.getloadavg()[0]
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run(
        [*command, "--kill-after", str(kill_after)], env=environment, capture_output=True, text=True, check=False
    )
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    lines = [line for line in done.stdout.splitlines() if line.startswith("answer:")]
    if not lines and not kill_after:
        sys.exit(f"{kind}, {workers} workers: {done.stdout}{done.stderr}")
    answer = json.loads(lines[-1][len("answer:") :]) if lines else {"error": "mpirun ends all of its processes"}
    answer["processor"] = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    answer["load"] = load
    print(f"{kind} {workers} {answer}", file=sys.stderr, flush=True)
    return answer


def cell(answer):
    return f"{answer['seconds']:.1f} ({answer['processor']:.1f})"


def print_table(arguments, folder):
    workers = [int(w) for w in arguments.workers.split(",")]
    def fresh(name):
        return folder / f"store_{name}"

    def least_of_runs(kind, n):
        runs = []
        for i in range(arguments.repetitions):
            store = fresh(f"{kind}_{n}_{i}")
            runs.append(run(scans, kind, n, store))
            counts.append(len(list(store.glob("*.pair"))))
            shutil.rmtree(store)
        answers.extend(runs)
        return min(runs, key=lambda answer: answer["seconds"])

    scans = folder / "scans"
    scans.mkdir()
    simulate_scans(scans, arguments.scans, arguments.samples)
    answers, counts = [], []
    single = least_of_runs("none", 1)
    threads = least_of_runs("none", os.cpu_count() or 1)
    pairs = counts[0]
    rows = []
    for kind in arguments.executors.split(","):
        if importlib.util.find_spec(MODULES[kind]) is None or (kind == "mpi" and not shutil.which("mpirun")):
            rows.append([NAMES[kind], *("not installed" for _ in workers), ""])
            continue
        row = [NAMES[kind]]
        for n in workers:
            row.append(cell(least_of_runs(kind, n)))
        store = fresh(f"{kind}_killed")
        broken = run(scans, kind, 3, store, kill_after=max(1, pairs // 2))
        if "digest" in broken:
            answers.append(broken)
            row.append(f"the same answer, {broken['seconds']:.1f} seconds" if broken["killed"] else "none was killed")
        else:
            kept = len(list(store.glob("*.pair")))
            answers.append(run(scans, kind, 3, store))
            row.append(
                f"{broken['error']}; {kept} of {pairs} pairs are in the store, with which the next run gives the same "
                f"answer in {answers[-1]['seconds']:.1f} seconds"
            )
        rows.append(row)
    loads = [a["load"] for a in answers]
    print(f"{arguments.scans} scans of {arguments.samples} x {arguments.samples} cells, {pairs} pairs, "
          f"{single['components']} component{'s' if single['components'] > 1 else ''}")
    print(f"{os.cpu_count()} processors ({processor_name()}), Python {platform.python_version()}, "
          f"load before a run {min(loads):.1f} to {max(loads):.1f}")
    print(f"\nSeconds (processor seconds). Without an executor {cell(single)} by one thread, {cell(threads)} by all.\n")
    head = ["executor", *(f"{n} worker{'s' if n > 1 else ''}" for n in workers), "one of three is killed in the middle"]
    for row in [head, ["---"] * len(head), *rows]:
        print("|", " | ".join(row), "|")
    if any(a.get("digest") != single["digest"] for a in answers):
        sys.exit("an answer has other bits")
    print("\nAll answers are the same, bit by bit.")


def processor_name():
    try:
        with open("/proc/cpuinfo", encoding="ascii", errors="replace") as info:
            return next(line.split(":")[1].strip() for line in info if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scans", type=int, default=100, help="how many views of the body are made")
    parser.add_argument("--samples", type=int, default=200, help="columns and rows of a view's grid")
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--executors", default="processes,dask,mpi")
    parser.add_argument("--workers", default="1,2,3,4")
    for name in ("folder", "run", "store"):
        parser.add_argument(f"--{name}", help=argparse.SUPPRESS)  # of a run
    for name in ("count", "kill-after"):
        parser.add_argument(f"--{name}", type=int, default=0, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.run:
        run_one(arguments)
        return
    with tempfile.TemporaryDirectory() as folder:
        print_table(arguments, pathlib.Path(folder))


if __name__ == "__main__":
    main()
