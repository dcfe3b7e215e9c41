# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a test of the Python module where the modules that it needs are there: run.py MODULE,... ARGUMENT...

A name such as program:mpirun is that of a program.

The arguments are those of a module that is run as a program (`-m pytest tests`), or of a file. Where a module is missing
it says so, and ends with 77, which ctest shows as skipped.
"""

import importlib.util
import shutil
import subprocess
import sys



def is_missing(name):
    kind, colon, program = name.partition(":")
    return shutil.which(program) is None if colon else importlib.util.find_spec(kind) is None


missing = [name for name in sys.argv[1].split(",") if is_missing(name)]
if missing:
    print("skipped: there is no", ", ".join(missing))
    sys.exit(77)
sys.exit(subprocess.call([sys.executable, *sys.argv[2:]]))
