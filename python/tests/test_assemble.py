# SPDX-License-Identifier: GPL-3.0-or-later
"""assemble(): right poses, the same bits by any executor, and ends that are told."""

import concurrent.futures
import multiprocessing
import pickle

import numpy as np
import pytest

import crude_registration as cr
from conftest import degrees_between, true_motion


def bits(result):
    return pickle.dumps((result.number_of_components, result.scans, result.edges, result.overlaps))


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
    assert bits(cr.assemble(files, store=tmp_path / "pairs")) == bits(alone)
    assert {p: p.stat().st_mtime_ns for p in (tmp_path / "pairs").iterdir()} == kept


def test_bad_arguments_are_named(files, tmp_path):
    assert cr.assemble([]).scans == []
    with pytest.raises(FileNotFoundError, match="missing.ply"):
        cr.assemble([files[0], tmp_path / "missing.ply"])
    with concurrent.futures.ThreadPoolExecutor(1) as executor:
        with pytest.raises(ValueError, match="store"):
            cr.assemble(files, executor=executor, store=tmp_path)
    with pytest.raises(ValueError, match="time_budget"):
        cr.assemble(files, time_budget=-1)
