# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a test of the Python module where the modules that it needs are there: run.py MODULE,... ARGUMENT...

The arguments are those of a module that is run as a program (`-m pytest tests`), or of a file. Where a module is missing
it says so, and ends with 77, which ctest shows as skipped.
"""

import importlib.util
import subprocess
import sys

missing = [name for name in sys.argv[1].split(",") if importlib.util.find_spec(name) is None]
if missing:
    print("skipped: there is no Python module", ", ".join(missing))
    sys.exit(77)
sys.exit(subprocess.call([sys.executable, *sys.argv[2:]]))
