# SPDX-License-Identifier: GPL-3.0-or-later
"""assemble(): right poses, the same bits by any executor, and ends that are told."""

import concurrent.futures
import multiprocessing
import os
import pathlib
import pickle
import shutil
import signal

import numpy as np
import pytest
from conftest import bits, degrees_between, true_motion

import crude_registration as cr
from crude_registration import _assembly, _core


@pytest.fixture(scope="module")
def alone(files):
    return cr.assemble(files)


def test_a_folder_is_one_model(alone, views):
    assert alone.components == [list(range(len(views)))]
    assert not alone.is_interrupted
    for scan, view in zip(alone.scans, views):
        truth = true_motion(view, views[0])
        middle = np.append(view.image.points.mean(axis=0), 1)
        assert degrees_between(scan.T_model_scan, truth) < 1
        assert np.linalg.norm((scan.T_model_scan - truth) @ middle) < 2 * cr.Scan(view.image).spacing
        assert scan.reason == "" and scan.covariance.shape == (6, 6)
    for edge in alone.edges:
        if edge.status is cr.EdgeStatus.USED:
            assert edge.registration is not cr.RegistrationStatus.NOT_REGISTERED
    assert repr(alone) == "<AssemblyResult: 6 scans in components of 6>"


def test_the_same_bits_by_any_executor(alone, files, views):
    assert bits(cr.assemble(files, parallel=False)) == bits(alone)
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as executor:
        assert bits(cr.assemble(files, executor=executor)) == bits(alone)
        scans = [cr.Scan(f) for f in files]
        assert bits(cr.assemble(scans, executor=executor, parallel=False)) == bits(alone)
    with concurrent.futures.ThreadPoolExecutor(3) as executor:
        assert bits(cr.assemble([cr.read_scan(f) for f in files], executor=executor)) == bits(alone)
        images = [v.image for v in views]
        grids = [np.full(i.grid.shape + (3,), np.nan) for i in images]
        for grid, image in zip(grids, images):
            grid[image.grid >= 0] = image.points[image.grid[image.grid >= 0]]
        assert bits(cr.assemble(grids, executor=executor)) == bits(cr.assemble(grids))


class Counting(concurrent.futures.ThreadPoolExecutor):
    """Fails in the place of a task, and counts those that were asked for."""

    def __init__(self, last):
        super().__init__(1)
        self.last = last
        self.count = 0

    def submit(self, function, /, *arguments, **named):
        self.count += 1
        if self.count > self.last:
            return super().submit(self.fail)
        return super().submit(function, *arguments, **named)

    @staticmethod
    def fail():
        raise OSError("the worker is gone")


def test_the_error_of_a_task_is_passed_on(files):
    for last in (2, len(files) + 3):
        with Counting(last) as executor:
            with pytest.raises(OSError, match="the worker is gone"):
                cr.assemble(files, executor=executor)


def test_a_run_that_is_ended_says_so(files):
    scans = [cr.Scan(f) for f in files]
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        for arguments in ({"progress": lambda share: False}, {"time_budget": 1e-3}):
            result = cr.assemble(scans, executor=executor, **arguments)
            assert result.is_interrupted and result.number_of_components == len(files)
            assert all("interrupted" in s.reason for s in result.scans)

        def broken(share):
            raise KeyError("progress")

        with pytest.raises(KeyError):
            cr.assemble(scans, executor=executor, progress=broken)


def test_a_store_keeps_what_was_registered(alone, files, tmp_path):
    assert bits(cr.assemble(files, store=tmp_path / "pairs")) == bits(alone)
    kept = {p: p.stat().st_mtime_ns for p in (tmp_path / "pairs").iterdir()}
    assert len(kept) == len(alone.edges)
    assert bits(cr.assemble(files, store=os.fsencode(tmp_path / "pairs"))) == bits(alone)
    assert {p: p.stat().st_mtime_ns for p in (tmp_path / "pairs").iterdir()} == kept


def test_bad_arguments_are_named(files, tmp_path):
    assert cr.assemble([]).scans == []
    with pytest.raises(FileNotFoundError, match="missing.ply"):
        cr.assemble([files[0], tmp_path / "missing.ply"])
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        with pytest.raises(FileNotFoundError, match="missing.ply"):
            cr.assemble([files[0], tmp_path / "missing.ply"], executor=executor, store=tmp_path / "store")
        with pytest.raises(OSError):
            cr.assemble(files, executor=executor, store=files[0])
    with pytest.raises(ValueError, match=r"viewpoint: three numbers are needed, not an array of shape \(2,\)"):
        cr.assemble(files, viewpoint=(0, 1))
    with pytest.raises(ValueError, match="time_budget"):
        cr.assemble(files, time_budget=-1)


class Weighing(concurrent.futures.ThreadPoolExecutor):
    """Notes how many bytes each task has when it is sent to another process."""

    def __init__(self):
        super().__init__(1)
        self.weights = []

    def submit(self, function, /, *arguments, **named):
        self.weights.append(len(pickle.dumps((function, arguments, named))))
        return super().submit(function, *arguments, **named)


def test_tasks_carry_paths_and_hashes_not_scans(alone, files, views, tmp_path):
    with Weighing() as executor:
        for arguments in ({}, {"store": tmp_path / "store"}):
            assert bits(cr.assemble(files, executor=executor, **arguments)) == bits(alone)
        # What is no file is found in the store, too.
        scans = [cr.Scan(v.image) for v in views]
        assert bits(cr.assemble(scans, executor=executor, store=tmp_path / "other")) == bits(alone)
        assert max(executor.weights) < len(scans[0].to_bytes()) / 100
        assert len(executor.weights) == 2 * len(files) + 3 * len(alone.edges)


@pytest.fixture
def counts(monkeypatch):
    """How often a pair is registered, and a scan prepared, by the threads of this process."""
    count = {"register_pair": 0, "Scan": 0}

    def register_pair(*arguments):
        count["register_pair"] += 1
        return _core.register_pair(*arguments)

    class Core:
        def __getattr__(self, name):
            return register_pair if name == "register_pair" else getattr(_core, name)

        def __init__(self):
            class Scan(_core.Scan):
                def __init__(self, *arguments, **named):
                    count["Scan"] += 1
                    super().__init__(*arguments, **named)

            self.Scan = Scan

    monkeypatch.setattr(_assembly, "_core", Core())
    return count


def test_a_store_is_shared_by_all_runs(alone, files, tmp_path, counts):
    store = tmp_path / "store"
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        assert bits(cr.assemble(files[:4], executor=executor, store=store)) == bits(cr.assemble(files[:4]))
        first = dict(counts)
        assert first["Scan"] == 4 + 4 and 3 <= first["register_pair"] <= 6
        assert bits(cr.assemble(files, executor=executor, store=store)) == bits(alone)
        assert counts["Scan"] == first["Scan"] + len(files) - 4
        assert counts["register_pair"] == len(list(store.glob("*.pair"))) >= len(alone.edges)
        second = dict(counts)
        # Files are known by what is in them. Names need not be UTF-8.
        moved = pathlib.Path(os.fsdecode(os.fsencode(tmp_path) + b"/moved\xff"))
        moved.mkdir()
        store = store.rename(moved / "store")
        copies = [shutil.copy(f, moved) for f in files]
        assert bits(cr.assemble(copies, executor=executor, store=store)) == bits(alone)
        assert counts == second
        # Without an executor the same pairs are found.
        kept = {p: p.stat().st_mtime_ns for p in store.iterdir()}
        assert bits(cr.assemble(files, store=store)) == bits(alone)
        assert {p: p.stat().st_mtime_ns for p in store.iterdir()} == kept


def test_what_is_damaged_in_a_store_is_made_again(alone, files, tmp_path):
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        assert bits(cr.assemble(files, executor=executor, store=tmp_path)) == bits(alone)
        for i, path in enumerate(sorted(tmp_path.iterdir())):
            content = path.read_bytes()
            path.write_bytes([content[: len(content) // 2], b"", b"x" + content[1:]][i % 3])
        assert bits(cr.assemble(files, executor=executor, store=tmp_path)) == bits(alone)


def test_a_file_that_changes_meanwhile_is_an_error(files, tmp_path):
    copies = [tmp_path / f.name for f in files]
    for file, copy in zip(files, copies):
        shutil.copy(file, copy)

    class Changing(concurrent.futures.ThreadPoolExecutor):
        def submit(self, function, /, *arguments, **named):
            if function is _assembly._register:
                shutil.copy(files[0], copies[1])
            return super().submit(function, *arguments, **named)

    with Changing(1) as executor:
        with pytest.raises(OSError, match="scan_1.ply: the file is another one"):
            cr.assemble(copies, executor=executor)


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="there is no such signal")
def test_a_pool_that_breaks_leaves_what_it_has_done(alone, files, tmp_path):
    context = multiprocessing.get_context("spawn")

    def kill_one(share):
        if list(tmp_path.glob("*.pair")):
            os.kill(next(iter(executor._processes)), signal.SIGKILL)

    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as executor:
        with pytest.raises(concurrent.futures.process.BrokenProcessPool):
            cr.assemble(files, executor=executor, store=tmp_path, progress=kill_one)
    kept = {p: p.stat().st_mtime_ns for p in tmp_path.glob("*.pair")}
    assert kept
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as executor:
        assert bits(cr.assemble(files, executor=executor, store=tmp_path)) == bits(alone)
    assert all(path.stat().st_mtime_ns == time for path, time in kept.items())
