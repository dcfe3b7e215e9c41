# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the Python module by the CMake project of this package; pyproject.toml says what it is."""

import sys

from skbuild import setup

setup(
    packages=["crude_registration"],
    package_dir={"crude_registration": "python/crude_registration"},
    package_data={"crude_registration": ["py.typed", "*.pyi"]},
    zip_safe=False,
    cmake_install_dir="python/crude_registration",
    cmake_install_target="install_python",
    cmake_args=[
        f"-DCRUDE_REGISTRATION_PYTHON={sys.executable}",
        "-DCRUDE_REGISTRATION_PYTHON_DIR=.",
        *(
            f"-DCRUDE_REGISTRATION_WITH_{part}=OFF"
            for part in ("TESTS", "APPS", "EXAMPLES", "BENCHMARKS", "DOC")
        ),
        "-DBUILD_TESTING=OFF",
    ],
)
