# SPDX-License-Identifier: GPL-3.0-or-later
"""Looks whether the Python example of README.md is the first one of examples/python, and the versions agree."""

import pathlib
import re
import sys

root = pathlib.Path(sys.argv[1])
readme = (root / "README.md").read_text(encoding="utf-8")
example = (root / "examples/python/1_register_files.py").read_text(encoding="utf-8")
if f"```python\n{example}```\n" not in readme:
    sys.exit("README.md does not show examples/python/1_register_files.py")
cmake = re.search(r"project\(Crude_registration VERSION ([0-9.]+)", (root / "CMakeLists.txt").read_text(encoding="utf-8"))
pip = re.search(r'^version = "(.*)"$', (root / "pyproject.toml").read_text(encoding="utf-8"), re.MULTILINE)
if not cmake or not pip or cmake.group(1) != pip.group(1):
    sys.exit("CMakeLists.txt and pyproject.toml have different versions")
