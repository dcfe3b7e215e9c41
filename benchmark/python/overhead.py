#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints what a call of register() from Python takes beyond the work of C++, for two scans of about 40,000 samples.

PYTHONPATH=build/python benchmark/python/overhead.py

Of arrays: a run whose time budget is over before it begins does all that the module does of itself: it takes the
arguments, copies arrays, lets go of the lock of the interpreter and takes it again, and makes a result. Of prepared
Scans: the time of a call that is none of the stages which its statistics tell. The least of many calls is what a call
costs, however loaded the machine is. Of a mesh the vertices and faces are made a CGAL::Surface_mesh, which a program in
C++ has to do, too, for arrays.
"""

import argparse
import time

import numpy as np

import crude_registration as cr


def least_milliseconds(call, repetitions):
    times = []
    for _ in range(repetitions):
        begin = time.perf_counter()
        call()
        times.append(time.perf_counter() - begin)
    return 1000 * min(times)


def beyond_stages(scans, repetitions):
    """The least and the median, in milliseconds, of the time of a call that no stage accounts for."""
    times = []
    for _ in range(repetitions):
        begin = time.perf_counter()
        result = cr.register(*scans, parallel=False)
        spent = time.perf_counter() - begin
        # A stage with a colon in its name is a part of another one; "reduce" was done when the scans were prepared.
        stages = [s.seconds for s in result.statistics if ":" not in s.name and s.name != "reduce"]
        times.append(1000 * (spent - sum(stages)))
    return min(times), float(np.median(times))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repetitions", type=int, default=200)
    parser.add_argument("--samples", type=int, default=510, help="columns and rows of the grid of a scan")
    arguments = parser.parse_args()
    statue = cr.make_statue()
    images = [cr.simulate(statue, (-np.cos(a), -np.sin(a), -0.25), samples=arguments.samples)[0] for a in (0, 0.7)]
    points = [image.points for image in images]
    meshes = [image.surface() for image in images]
    scans = [cr.Scan(image) for image in images]
    print("scans of", " and ".join(str(len(p)) for p in points), "samples; milliseconds of a call beyond the work of C++:")
    inputs = {
        "points, float64": points,
        "points, float32": [p.astype(np.float32) for p in points],
        "points, float64, column by column": [np.asfortranarray(p) for p in points],
    }
    for name, (source, target) in inputs.items():
        call = least_milliseconds(lambda: cr.register(source, target, time_budget=1e-9), arguments.repetitions)
        print(f"  {name}: {call:.2f}")
    call = least_milliseconds(lambda: cr.register(*meshes, time_budget=1e-9), max(1, arguments.repetitions // 10))
    print(f"  meshes, with making them of their arrays: {call:.2f}")
    least, median = beyond_stages(scans, arguments.repetitions)
    print(f"  Scans: {least:.2f}, in the median {median:.2f}")


if __name__ == "__main__":
    main()
