# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of the Python module share: views of a generated body, whose motions are known, made once."""

import os
import subprocess
from typing import NamedTuple

import numpy as np
import pytest
from hypothesis import HealthCheck, settings

import crude_registration as cr


def cases(number):
    """The same generated cases every time; CRUDE_REGISTRATION_CASES asks for so many others."""
    wanted = os.environ.get("CRUDE_REGISTRATION_CASES")
    return settings(
        max_examples=int(wanted or number),
        derandomize=wanted is None,
        database=None,
        deadline=None,
        suppress_health_check=list(HealthCheck),
    )


class View(NamedTuple):
    image: cr.ScanFile
    T_scene_scan: np.ndarray


@pytest.fixture(scope="session")
def statue():
    return cr.make_statue(resolution=48)


@pytest.fixture(scope="session")
def views(statue):
    """Six views around the body, 30 degrees apart."""
    angles = np.radians(30 * np.arange(6))
    return [
        View(*cr.simulate(statue, (-np.cos(a), -np.sin(a), -0.25), samples=150, noise=0.1, drop_out=0.01, seed=i))
        for i, a in enumerate(angles)
    ]


@pytest.fixture(scope="session")
def files(views, tmp_path_factory):
    folder = tmp_path_factory.mktemp("scans")
    paths = [folder / f"scan_{i}.ply" for i in range(len(views))]
    for view, path in zip(views, paths):
        view.image.write(path)
    return paths


@pytest.fixture(scope="session")
def crude_register():
    """Runs the program of the command line: the lines that it prints."""
    program = os.environ.get("CRUDE_REGISTER")
    if not program:
        pytest.skip("CRUDE_REGISTER does not name the program of the command line")

    def run(*arguments):
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, check=False)
        assert done.returncode in (0, 2, 3), done.stderr
        return done.stdout

    return run


def bits(result):
    """All of an AssemblyResult but its times, as text that is the same for the same bits."""
    scans = [(s.component, s.T_model_scan.tobytes(), s.reason, s.residual, s.covariance.tobytes()) for s in result.scans]
    return repr((result.number_of_components, scans, result.edges, result.overlaps))


def true_motion(source, target):
    return np.linalg.inv(target.T_scene_scan) @ source.T_scene_scan


def degrees_between(a, b):
    return np.degrees(np.arccos(np.clip((np.trace(a[:3, :3] @ b[:3, :3].T) - 1) / 2, -1, 1)))


def check_right(result, source, target, spacing):
    """Registered, to a degree and two sampling distances in the middle of the scan."""
    truth = true_motion(source, target)
    middle = np.append(source.image.points.mean(axis=0), 1)
    assert result.status is cr.RegistrationStatus.REGISTERED
    assert degrees_between(result.T_target_source, truth) < 1
    assert np.linalg.norm((result.T_target_source - truth) @ middle) < 2 * spacing
