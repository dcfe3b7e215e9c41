# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds a wheel by pip, of a copy of the sources, installs it into a new virtual environment, and runs an example there:
wheel.py SOURCES FOLDER [CORE], where CORE is the compiled core, which is compiled, too, if it is not given. Nothing is
fetched: scikit-build, pybind11 and numpy are those that are installed."""

import os
import pathlib
import shutil
import subprocess
import sys
import venv

sources, folder = map(pathlib.Path, sys.argv[1:3])
shutil.rmtree(folder, ignore_errors=True)
copy = folder / "sources"
parts = "CMakeLists.txt LICENSE.md README.md CHANGES.md apps cmake include python pyproject.toml setup.py src".split()
copy.mkdir(parents=True)
for part in parts:
    if (sources / part).is_dir():
        shutil.copytree(sources / part, copy / part)
    else:
        shutil.copy(sources / part, copy)
subprocess.run(
    [sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps", "--no-index", "-w", folder, copy],
    check=True,
    # Whether it can be built, and not how fast it is.
    env={**os.environ, "CMAKE_ARGS": " ".join((
        "-DCMAKE_CXX_FLAGS_RELEASE=-O0",
        "-DCMAKE_UNITY_BUILD_BATCH_SIZE=0",
        "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON",
        *(f"-DCRUDE_REGISTRATION_CORE={core}" for core in sys.argv[3:]),
    ))},
)
(wheel,) = folder.glob("crude_registration-*.whl")
venv.create(folder / "venv", system_site_packages=True, with_pip=True)
python = folder / "venv" / "bin" / "python"
subprocess.run([python, "-m", "pip", "install", "--no-deps", "--no-index", wheel], check=True)
program = """
import os, sys
import crude_registration as cr
assert cr.__file__.startswith(sys.prefix), cr.__file__
names = os.listdir(os.path.dirname(cr.__file__))
assert "py.typed" in names and "_core.pyi" in names, names
statue = cr.make_statue()
for i, direction in enumerate([(-1, 0, -0.25), (-0.7, -0.7, -0.25)]):
    cr.simulate(statue, direction, samples=200)[0].write(f"{i}.ply")
"""
subprocess.run([python, "-I", "-c", program], check=True, cwd=folder)
example = sources / "examples" / "python" / "1_register_files.py"
done = subprocess.run([python, "-I", example, "0.ply", "1.ply"], check=True, cwd=folder, capture_output=True, text=True)
print(done.stdout)
assert "RegistrationResult: registered" in done.stdout
