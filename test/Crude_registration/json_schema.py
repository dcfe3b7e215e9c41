#!/usr/bin/env python3
# Copyright (c) 2026 The Crude_registration authors.
# All rights reserved.
#
# This file is part of the CGAL package Crude_registration.
#
# SPDX-License-Identifier: GPL-3.0-or-later
"""What `crude_register --json` prints is what its schema describes: json_schema.py PROGRAM SCHEMA FOLDER."""
import copy
import json
import os
import shutil
import subprocess
import sys

try:
    import jsonschema
except ImportError:
    print("skipped: there is no jsonschema for Python (python3-jsonschema)")
    sys.exit(0)

PROGRAM, SCHEMA, FOLDER = (os.path.abspath(name) for name in sys.argv[1:4])


def answer(expected, *arguments):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False)
    assert done.returncode == expected, done

    def refuse(name):
        raise AssertionError(f"{name} is no JSON")

    return json.loads(done.stdout, parse_constant=refuse) if "--json" in arguments else None


def main():
    with open(SCHEMA, encoding="utf-8") as file:
        schema = json.load(file)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    shutil.rmtree(FOLDER, ignore_errors=True)
    os.makedirs(FOLDER)
    os.chdir(FOLDER)
    answer(0, "simulate", "--output", "scans", "--samples", "150")
    answer(0, "simulate", "--output", "other", "--samples", "150", "--scans", "1", "--seed", "5")
    for i in range(2):
        with open(f"plane_{i}.xyz", "w", encoding="utf-8") as file:
            file.writelines(f"{x} {y} 0\n" for x in range(40 - 10 * i) for y in range(30 + 10 * i))
    pair, others, planes = ["scans/scan_0.ply", "scans/scan_1.ply"], ["scans/scan_0.ply", "other/scan_0.ply"], ["plane_0.xyz", "plane_1.xyz"]
    registered = answer(0, "register", *pair, "--json")
    with open("answer.json", "w", encoding="utf-8") as file:
        json.dump(registered, file)
    with open("wrong.txt", "w", encoding="utf-8") as file:
        file.write("0 -1 0 0\n1 0 0 0\n0 0 1 0\n")
    answers = [
        registered,
        answer(0, "register", *pair, "--json", "--times", "--poses", "scans/poses.txt", "--output", "moved", "--apply", "moved.ply"),
        answer(3, "register", *others, "--json"),
        answer(0, "register", *pair, "--estimate-scale", "--json"),
        answer(3, "register", *others, "--estimate-scale", "--json"),
        answer(3, "register", *pair, "--json", "--time-budget", "1e-9"),
        answer(2, "register", *planes, "--json"),
        answer(0, "judge", *pair, "--motion", "answer.json", "--json"),
        answer(3, "judge", *pair, "--motion", "wrong.txt", "--json"),
        answer(0, "assemble", *pair, "other/scan_0.ply", "--json", "--times"),
        answer(3, "assemble", *others, "--json"),
        answer(0, "info", pair[0], "--json"),
        answer(0, "info", planes[0], "--viewpoint", "0,0,100", "--json"),
    ]
    for a in answers:
        errors = [f"{list(e.absolute_path)}: {e.message}" for e in jsonschema.Draft7Validator({"$ref": "#/definitions/" + a["command"], **{"definitions": schema["definitions"]}}).iter_errors(a)]
        assert not errors, (a["command"], errors)
        assert validator.is_valid(a), a["command"]
        # each member counts, and no other is allowed
        optional = {"error", "preparation_seconds", "search_seconds", "columns", "rows", "normals_towards_sensor",
                    "estimated_scale", "estimated_scale_deviation"}
        for member in set(a) - optional:
            less = copy.deepcopy(a)
            del less[member]
            assert not validator.is_valid(less), member
        assert not validator.is_valid({**a, "another": 1})
    print(len(answers), "answers are as the schema says")


main()
