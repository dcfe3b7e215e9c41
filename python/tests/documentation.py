# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs every example of the documentation, and looks whether all that is public has one sentence at least."""

import doctest
import inspect
import itertools
import re
import sys

import crude_registration as cr

failures = 0
examples = 0
for name in ["", *cr.__all__]:
    thing = getattr(cr, name) if name else cr
    label = f"crude_registration.{name}".rstrip(".")
    text = inspect.getdoc(thing) or ""
    if not text.strip():
        print(label, "is not documented")
        failures += 1
    test = doctest.DocTestParser().get_doctest(text, {}, label, None, None)
    result = doctest.DocTestRunner().run(test)
    failures += result.failed
    examples += result.attempted
    if inspect.isclass(thing) and not issubclass(thing, (tuple, Exception)):
        for member, value in vars(thing).items():
            if not member.startswith("_") and not (inspect.getdoc(value) or "").strip():
                print(f"{label}.{member} is not documented")
                failures += 1
    if inspect.isclass(thing):
        fields = (getattr(thing, name, ()) for name in ("_fields", "__dataclass_fields__", "__members__"))
        for member in itertools.chain(*fields):
            if not re.search(rf"^(\w+, )*{member}(, \w+)*: ", text, re.MULTILINE):
                print(f"{label}.{member} is not documented")
                failures += 1
    if thing is not cr and thing.__module__ != "crude_registration":
        print(label, "is said to be in", thing.__module__)
        failures += 1
    if inspect.isroutine(thing) and "typing" in str(inspect.signature(thing)):
        print(label, "has a signature that help() shows badly")
        failures += 1
    if inspect.isbuiltin(thing):
        inspect.signature(thing)  # a ValueError where help() cannot show one
if examples < 20:
    print("only", examples, "examples were found")
    failures += 1
sys.exit(failures > 0)
