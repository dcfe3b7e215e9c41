# SPDX-License-Identifier: GPL-3.0-or-later
"""register: the answers are right, are those of C++ to the bit, and can be ended."""

import itertools
import json
import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest
from conftest import check_right, true_motion

import crude_registration as cr


def check_same(result, text):
    """All that a result says is what the program prints, which adds the names of files and what else is of files."""
    answer, printed = json.loads(result.to_json()), json.loads(text)
    assert {"status", "confidence", "target_from_source", "covariance", "runners_up", "statistics"} <= set(answer)
    assert answer == {name: printed.get(name) for name in answer}


def test_views_are_registered(views):
    scans = [cr.Scan(v.image) for v in views]
    for i in range(len(views) - 1):
        check_right(cr.register(scans[i], scans[i + 1]), views[i], views[i + 1], scans[i].spacing)


def test_trihedra_register_too(views):
    result = cr.register(views[0].image, views[1].image, method="trihedra")
    check_right(result, views[0], views[1], cr.Scan(views[0].image).spacing)
    prepared = [cr.Scan(v.image, method="trihedra") for v in views[:2]]
    assert cr.register(*prepared, method="trihedra").to_json() == result.to_json()
    with pytest.raises(ValueError, match="not simplified"):
        cr.register(prepared[0], cr.Scan(views[1].image), method="trihedra")


def test_the_answers_are_those_of_the_program_to_the_bit(files, tmp_path, crude_register):
    other = tmp_path / "other.ply"
    cr.simulate(cr.make_statue(resolution=48, seed=3), (0, 1, 0.3), samples=150)[0].write(other)
    pairs = list(itertools.permutations(range(len(files)), 2)) + [(0, len(files)), (len(files), 1)]
    assert len(pairs) == 32
    files = [*files, other]
    scans = [cr.Scan(f) for f in files]
    statuses = set()
    for i, j in pairs:
        printed = crude_register("register", files[i], files[j], "--json")
        result = cr.register(scans[i], scans[j])
        statuses.add(result.status)
        check_same(result, printed)
        assert result.T_target_source[:3].tolist() == json.loads(printed)["target_from_source"]
        assert result.confidence == json.loads(printed)["confidence"]
    assert cr.RegistrationStatus.REGISTERED in statuses and len(statuses) > 1


def test_files_arrays_and_parameters_give_the_answers_of_the_program(files, crude_register):
    a, b = files[0], files[1]
    printed = crude_register("register", a, b, "--json")
    check_same(cr.register(a, str(b)), printed)
    check_same(cr.register(os.fsencode(a), cr.read_scan(b), parallel=False), printed)
    printed = crude_register("register", a, b, "--json", "--method", "trihedra", "--f2", "0.4")
    check_same(cr.register(a, b, method="trihedra", maximum_extent=0.4), printed)
    printed = crude_register("register", a, b, "--json", "--f1", "0.1", "--f2", "0.5")
    check_same(cr.register(a, b, minimum_extent=0.1, maximum_extent=0.5), printed)


def test_meshes_and_points_give_the_answers_of_the_program(views, tmp_path, crude_register):
    meshes = [v.image.surface() for v in views[:2]]
    for i, mesh in enumerate(meshes):
        with open(tmp_path / f"mesh_{i}.off", "w", encoding="ascii") as off:
            off.write(f"OFF\n{len(mesh.points)} {len(mesh.faces)} 0\n")
            off.writelines(f"{p[0]!r} {p[1]!r} {p[2]!r}\n" for p in mesh.points.tolist())
            off.writelines(f"3 {f[0]} {f[1]} {f[2]}\n" for f in mesh.faces.tolist())
        with open(tmp_path / f"points_{i}.xyz", "w", encoding="ascii") as xyz:
            xyz.writelines(f"{p[0]!r} {p[1]!r} {p[2]!r}\n" for p in mesh.points.tolist())
    printed = crude_register("register", tmp_path / "mesh_0.off", tmp_path / "mesh_1.off", "--json")
    check_same(cr.register(*meshes), printed)
    printed = crude_register(
        "register", tmp_path / "points_0.xyz", tmp_path / "points_1.xyz", "--json", "--viewpoint", "0,0,9"
    )
    answer = cr.register(meshes[0].points, meshes[1].points, viewpoint=(0, 0, 9))
    check_same(answer, printed)
    # Nothing tells the side from which they were seen: both are tried.
    printed = crude_register("register", tmp_path / "points_0.xyz", tmp_path / "points_1.xyz", "--json")
    check_same(cr.register(meshes[0].points, meshes[1].points), printed)
    printed = crude_register(
        "register", tmp_path / "points_0.xyz", tmp_path / "points_1.xyz", "--json", "--method", "trihedra"
    )
    check_same(cr.register(meshes[0].points, meshes[1].points, method="trihedra"), printed)
    same = cr.register(meshes[0].points, meshes[1].points, source_viewpoint=[0, 0, 9], target_viewpoint=np.array([0, 0, 9]))
    assert same.to_json() == answer.to_json()


def test_a_grid_is_a_range_image(views):
    image = views[0].image
    grid = np.full(image.grid.shape + (3,), np.nan)
    grid[image.grid >= 0] = image.points[image.grid[image.grid >= 0]]
    expected = cr.register(cr.Scan(image), views[1].image)
    answer = cr.register(grid, views[1].image, source_viewing_direction=image.viewing_direction)
    assert answer.to_json() == expected.to_json()


def test_scales_are_found_as_by_the_program(views, tmp_path, crude_register):
    a, b = views[0].image.points, views[1].image.points
    paths = [tmp_path / "a.npy", tmp_path / "b.npy"]
    np.save(paths[0], a / 25.4)
    np.save(paths[1], b)
    printed = json.loads(crude_register("register", *paths, "--estimate-scale", "--json"))
    answer = cr.register_with_scale(a / 25.4, b)
    assert json.loads(answer.registration.to_json()) == {
        name: printed.get(name) for name in json.loads(answer.registration.to_json())
    }
    assert answer.scale == printed["estimated_scale"] and answer.scale_deviation == printed["estimated_scale_deviation"]
    assert abs(answer.scale / 25.4 - 1) < 0.01 and 0 < answer.scale_deviation < 0.01
    check_right(answer.registration, views[0], views[1], cr.Scan(b).spacing)
    motion = answer.registration.T_target_source
    assert np.allclose(answer.similarity, motion @ np.diag([answer.scale] * 3 + [1]), rtol=1e-12, atol=1e-12)
    assert cr.register_with_scale(cr.Scan(paths[0]), cr.Scan(paths[1]), parallel=False)[:2] == answer[:2]
    other, _ = cr.simulate(cr.make_statue(resolution=48, seed=3), (0, 1, 0.3), samples=150)
    lost = cr.register_with_scale(a, other)
    assert lost.registration.status is not cr.RegistrationStatus.REGISTERED and lost.registration.reason
    ended = cr.register_with_scale(a, b, progress=lambda share: False)
    assert ended.scale == 1 and np.array_equal(ended.similarity, np.eye(4))
    assert "interrupted" in ended.registration.reason
    with pytest.raises(ValueError, match="register_with_scale: time_budget"):
        cr.register_with_scale(a, b, time_budget=-1)


def test_a_result_says_what_it_is(views):
    result = cr.register(views[0].image, views[1].image)
    assert repr(result).startswith("<RegistrationResult: registered, confidence 0.9") or "confidence 1" in repr(result)
    assert result.T_target_source.shape == result.crude_T_target_source.shape == (4, 4)
    assert result.covariance.shape == (6, 6)
    assert result.correspondence.shape == (2, 2, 3)
    lengths = np.linalg.norm(result.correspondence[0] - result.correspondence[1], axis=1)
    assert np.all(lengths > 0) and abs(lengths[0] - lengths[1]) < 0.2 * lengths[0]
    assert np.array_equal(result.covariance, result.covariance.T)
    assert np.all(np.linalg.eigvalsh(result.covariance) >= -1e-18)
    assert np.array_equal(result.poses[0].T_target_source, result.T_target_source)
    assert result.poses[0].score == result.score and result.poses[0].probability == result.confidence
    assert sum(pose.probability for pose in result.poses) < 1 + 1e-9
    assert len(result.poses) == 1 + len(result.runners_up)
    assert all(a.score >= b.score for a, b in zip(result.poses, result.poses[1:]))
    assert [s.name for s in result.statistics][0] == "reduce"
    assert "seconds" in result.to_json(times=True) and "seconds" not in result.to_json()
    assert result.reason == "" and result.free_motions == []
    with pytest.raises(AttributeError):
        result.confidence = 1


def test_what_is_changed_in_an_array_does_not_change_the_result(views):
    result = cr.register(views[0].image, views[1].image)
    result.T_target_source[:] = 0
    assert result.T_target_source[3, 3] == 1


def test_scans_of_different_bodies_are_not_registered(views):
    ball = cr.make_statue(resolution=48, seed=3)
    other, _ = cr.simulate(ball, (0, 1, 0.3), samples=150)
    result = cr.register(views[0].image, other)
    assert result.status is not cr.RegistrationStatus.REGISTERED
    assert result.reason
    assert str(result.status) in repr(result)


def test_results_are_pickled_to_the_bit(views):
    for result in (cr.register(views[0].image, v.image) for v in (views[1], views[3])):
        copy = pickle.loads(pickle.dumps(result))
        assert copy.to_json(times=True) == result.to_json(times=True)
        assert np.array_equal(copy.correspondence, result.correspondence)
    state = list(result.__getstate__())
    for i, wrong in ((0, 99), (1, 7), (5, 2.0), (16, np.zeros((2, 3)))):
        altered = state.copy()
        altered[i] = wrong
        with pytest.raises(ValueError, match="RegistrationResult"):
            cr.RegistrationResult.__new__(cr.RegistrationResult).__setstate__(tuple(altered))


def test_progress_is_told_and_ends_a_run(views):
    shares = []
    answer = cr.register(views[0].image, views[1].image, progress=shares.append)
    assert shares and all(0 <= s <= 1 for s in shares)
    assert answer.to_json() == cr.register(views[0].image, views[1].image).to_json()
    ended = cr.register(views[0].image, views[1].image, progress=lambda share: False)
    assert ended.status is not cr.RegistrationStatus.REGISTERED
    assert "interrupted" in ended.reason
    with pytest.raises(cr.PreparationInterrupted, match="interrupted"):
        cr.Scan(views[0].image, progress=lambda share: False)
    with pytest.raises(cr.PreparationInterrupted):
        cr.Scan(views[0].image, time_budget=1e-9)
    assert cr.register(*(v.image for v in views[:2]), time_budget=1e-9).status is cr.RegistrationStatus.NOT_REGISTERED
    assert cr.register(*(v.image for v in views[:2]), time_budget=1e300).to_json() == answer.to_json()


def test_what_progress_raises_is_passed_on(views):
    class Enough(Exception):
        pass

    def progress(share):
        raise Enough(share)

    for _ in range(5):
        with pytest.raises(Enough):
            cr.register(views[0].image, views[1].image, progress=progress)
        with pytest.raises(Enough):
            cr.register(cr.Scan(views[0].image), cr.Scan(views[1].image), progress=progress)


@pytest.fixture(scope="module")
def big():
    """A mesh whose preparation takes many times as long as a switch of threads."""
    return cr.make_statue(resolution=200)


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="there is no timer of signals")
def test_a_signal_ends_a_run(big):
    class Rang(Exception):
        pass

    def ring(*_):
        raise Rang

    before = signal.signal(signal.SIGALRM, ring)
    try:
        for _ in range(3):
            signal.setitimer(signal.ITIMER_REAL, 0.1)
            with pytest.raises(Rang):
                while True:
                    cr.Scan(big)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_ctrl_c_ends_a_registration(views):
    scans = [cr.Scan(v.image) for v in views[:2]]
    begun = []

    def press(share):
        if not begun:
            begun.append(threading.Timer(0.01, os.kill, (os.getpid(), signal.SIGINT)))
            begun[0].start()

    for call in (
        lambda: cr.register(views[0].image, views[1].image, progress=press),
        lambda: cr.register(*scans, method="pairs", progress=press),
        lambda: cr.judge(*scans, np.eye(4), progress=press),
        lambda: cr.assemble([v.image for v in views], progress=press),
    ):
        begun.clear()
        with pytest.raises(KeyboardInterrupt):
            while True:
                call()
        begun[0].join()
        cr.register(*scans)  # nothing is left behind


def test_other_threads_go_on(big):
    counts = []
    done = threading.Event()

    def count():
        while not done.is_set():
            counts.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    begin = time.monotonic()
    cr.Scan(big)
    end = time.monotonic()
    done.set()
    thread.join()
    # Copying the arrays needs the lock; most of the time does not.
    assert sum(begin < t < end for t in counts) > 3


def test_threads_share_scans(views):
    scans = [cr.Scan(v.image) for v in views[:3]]
    expected = [cr.register(scans[i], scans[j]).to_json() for i, j in itertools.permutations(range(3), 2)]
    answers = {}

    def work(k):
        answers[k] = [cr.register(scans[i], scans[j]).to_json() for i, j in itertools.permutations(range(3), 2)]

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for t in threads:
        t.start()
    for t in threads:
        t.join()
    assert all(answers[k] == expected for k in range(4))


def test_arguments_that_exclude_each_other_are_named(views):
    a, b = views[0].image, views[1].image
    for arguments, error in (
        ({"viewpoint": (0, 0, 0), "source_viewpoint": (0, 0, 0)}, "viewpoint is that of both"),
        ({"source_viewpoint": (0, 0, 0), "source_viewing_direction": (0, 0, 1)}, "both viewpoint and viewing_direction"),
        ({"method": "magic"}, "pairs or trihedra, not 'magic'"),
        ({"maximum_extent": -1.0}, "extent"),
        ({"time_budget": 0}, "time_budget has to be"),
        ({"viewpoint": (0, 0)}, r"viewpoint: three numbers are needed, not an array of shape \(2,\)"),
        ({"method": "trihedra", "tolerance": -1}, "tolerance"),
        ({"method": "trihedra", "number_of_vertices": -1}, "number_of_vertices"),
    ):
        with pytest.raises(ValueError, match=error):
            cr.register(a, b, **arguments)
    with pytest.raises(ValueError, match="the target is a Scan, which knows its sensor"):
        cr.register(a, cr.Scan(b), target_viewpoint=(0, 0, 0))


def test_refine_finds_the_true_motion(views):
    truth = true_motion(views[0], views[1])
    moved = truth.copy()
    moved[:3, 3] += 0.02
    refined = cr.refine(views[0].image, views[1].image, moved)
    assert refined.is_converged
    assert np.abs(refined.T_target_source - truth).max() < 0.01
    assert np.array_equal(
        cr.refine(views[0].image, views[1].image, moved[:3], parallel=False).T_target_source, refined.T_target_source
    )
    skew = truth.copy()
    skew[0, 0] += 0.1
    with pytest.raises(ValueError, match="rigid"):
        cr.refine(views[0].image, views[1].image, skew)
    with pytest.raises(TypeError, match="Scan"):
        cr.refine(cr.Scan(views[0].image), views[1].image, truth)


def test_motions_are_judged_as_by_the_program(views, files, tmp_path, crude_register):
    truth = true_motion(views[0], views[1])
    shifted, turned = truth.copy(), truth.copy()
    shifted[:3, 3] += 0.05
    turned[:3, :3] = turned[:3, :3] @ np.diag([1.0, -1.0, -1.0])
    statuses = []
    for name, motion in (("truth", truth), ("shifted", shifted), ("turned", turned)):
        np.savetxt(tmp_path / name, motion, fmt="%.17g")
        printed = json.loads(crude_register("judge", files[0], files[1], "--motion", tmp_path / name, "--json"))
        judgement = cr.judge(cr.Scan(views[0].image), files[1], motion)
        assert json.loads(judgement.refined.to_json()) == printed["refined"]
        assert judgement.displacement == printed["displacement"] and str(judgement.status) == printed["verdict"]
        assert judgement.confidence == judgement.refined.confidence
        assert cr.judge(files[0], files[1], motion[:3], parallel=False)[:3] == judgement[:3]
        statuses.append(judgement.status)
    assert statuses == [cr.MotionStatus.RIGHT, cr.MotionStatus.REFINABLE, cr.MotionStatus.WRONG]
    with pytest.raises(ValueError, match="not rigid"):
        cr.judge(files[0], files[1], np.eye(4) * [2, 1, 1, 1])
    with pytest.raises(cr.PreparationInterrupted):
        cr.judge(files[0], files[1], truth, time_budget=1e-9)
