#!/usr/bin/env python3
# Copyright (c) 2026 The Crude_registration authors.
# All rights reserved.
#
# This file is part of the CGAL package Crude_registration.
#
# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the command line program on a terminal: terminal.py PROGRAM FOLDER, a folder of its own to work in.

A run shows its stage; Ctrl-C ends it in each stage with what there is and exit code 130. Pipes stand for files that are
slow, so that the stage in which the key is pressed does not depend on time.
"""
import os
import pty
import shutil
import signal
import subprocess
import sys
import threading
import time

PROGRAM = os.path.abspath(sys.argv[1])
FOLDER = sys.argv[2]
CTRL_C = b"\x03"


class Terminal:
    """A run of the program on a terminal of its own; its standard output goes to a file."""

    def __init__(self, *arguments):
        self.seen = ""
        self.pid, self.terminal = pty.fork()
        if self.pid == 0:
            os.environ["TERM"] = "xterm"
            out = os.open("out.txt", os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o644)
            os.dup2(out, 1)
            os.execv(PROGRAM, [PROGRAM, *arguments])

    def read(self):
        """Some of what is shown; False at the end."""
        try:
            data = os.read(self.terminal, 4096)
        except OSError:  # as Linux says that the other side is closed
            return False
        self.seen += data.decode()
        return len(data) > 0

    def wait_for(self, text):
        while text not in self.seen:
            if not self.read():
                raise AssertionError(f"{text!r} is not shown, but {self.seen!r}")

    def press(self, key):
        os.write(self.terminal, key)

    def end(self):
        """The exit code."""
        while self.read():
            pass
        _, status = os.waitpid(self.pid, 0)
        os.close(self.terminal)
        return os.waitstatus_to_exitcode(status)


def check(condition, *what):
    if not condition:
        raise AssertionError(*what)


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL)


def output():
    with open("out.txt", encoding="utf-8") as file:
        return file.read()


def make_pipe(name):
    if os.path.exists(name):
        os.remove(name)
    os.mkfifo(name)


def feed_to(pipe, contents):
    """Writes to a pipe, if the program reads it."""

    def feed():
        with open(pipe, "wb") as file:
            try:
                file.write(contents)
            except BrokenPipeError:
                pass

    threading.Thread(target=feed, daemon=True).start()


def no_remains():
    remains = [name for name in os.listdir(".") if ".part" in name]
    check(not remains, remains)


SCANS = ["scans/scan_0.ply", "scans/scan_1.ply"]


def nothing_is_shown_where_errors_go_to_a_file():
    done = run("register", *SCANS)
    check(done.returncode == 0 and done.stderr == "", done)


def progress_is_shown():
    terminal = Terminal("register", *SCANS, "--output", "whole")
    check(terminal.end() == 0)
    for stage in ("reading and preparing the scans", "registering", "writing"):
        check(f"\r\x1b[K{stage}" in terminal.seen, terminal.seen)
    check(terminal.seen.endswith("\r\x1b[K"), terminal.seen)  # the last line is taken away
    check("status:     registered" in output())
    check("\x1b" not in output())


def interrupted_while_scans_are_read():
    with open(SCANS[0], "rb") as file:
        contents = file.read()
    for command, answer in (
        (["register", "slow.ply", SCANS[1], "--output", "nothing"], "interrupted: the preparation of"),
        (["assemble", "slow.ply", SCANS[1], "--poses", "nothing"], ""),
        (["judge", "slow.ply", SCANS[1], "--motion", "whole/motion.txt"], ""),
    ):
        make_pipe("slow.ply")
        terminal = Terminal(*command)
        terminal.wait_for("reading and preparing")
        terminal.press(CTRL_C)
        terminal.wait_for("^C")
        feed_to("slow.ply", contents)
        code = terminal.end()
        check(code == 130, command, code, terminal.seen)
        check(answer in output(), output())
        check(answer or "interrupted" in terminal.seen, terminal.seen)
        check(not os.path.exists("nothing"), command)


def interrupted_while_they_are_registered():
    # Two bodies that do not fit: the search goes on to its last round.
    for command, stage in (("register", "registering"), ("assemble", "assembling")):
        terminal = Terminal(command, "large/scan_0.ply", "other/scan_0.ply")
        terminal.wait_for(stage)
        terminal.press(CTRL_C)
        code = terminal.end()
        check(code == 130, command, code, terminal.seen, output())
    check("pairs were registered" in output(), output())


def interrupted_while_answers_are_written():
    make_pipe("slow_out.ply")
    terminal = Terminal("register", *SCANS, "--apply", "slow_out.ply", "--output", "moved")
    terminal.wait_for("writing")
    terminal.press(CTRL_C)
    terminal.wait_for("^C")
    with open("slow_out.ply", "rb") as file:
        written = file.read()
    code = terminal.end()
    check(code == 130, code)
    check(written.count(b"\n") == open(SCANS[0], "rb").read().count(b"\n"), "what is written is not whole")
    check("status:     registered" in output() and "written:    slow_out.ply" in output(), output())
    for name in ("source_moved.ply", "target.ply", "motion.txt"):
        check(os.path.exists(f"moved/{name}"), name)


def a_second_one_ends_at_once():
    make_pipe("slow.ply")
    terminal = Terminal("register", "slow.ply", SCANS[1])
    terminal.wait_for("reading and preparing")
    terminal.press(CTRL_C)
    terminal.wait_for("^C")
    # Two that come before the first is seen are one: as long as it takes.
    while os.waitid(os.P_PID, terminal.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT) is None:
        terminal.press(CTRL_C)
        time.sleep(0.01)
    check(terminal.end() == -signal.SIGINT)  # by the signal, as if nothing watched for it


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    os.makedirs(FOLDER)
    os.chdir(FOLDER)
    for folder, samples, seed in (("scans", 150, 0), ("large", 700, 0), ("other", 700, 5)):
        done = run("simulate", "--output", folder, "--samples", str(samples), "--seed", str(seed))
        check(done.returncode == 0, done)
    for test in (
        nothing_is_shown_where_errors_go_to_a_file,
        progress_is_shown,
        interrupted_while_scans_are_read,
        interrupted_while_they_are_registered,
        interrupted_while_answers_are_written,
        a_second_one_ends_at_once,
    ):
        test()
        no_remains()
        print(test.__name__.replace("_", " "))


main()
