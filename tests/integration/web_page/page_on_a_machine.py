#!/usr/bin/env python3
"""A machine that is up, in its own network, while a program of Node drives its page in a browser.

Usage: page_on_a_machine.py ROOT PROGRAMS COMMAND...    PROGRAMS: the folder of lockstep and lockstep-web
MACHINE_NAME in the environment names the machine; otherwise it has a name of its own.
"""
import os
import pathlib
import subprocess
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "web"))
from machine import Machine, own_network  # noqa: E402


def main():
    own_network()
    root, programs, *command = sys.argv[1:]
    with Machine(root, programs, "three-axis", os.environ.get("MACHINE_NAME")) as machine:
        sys.exit(subprocess.run(command, env={**machine.env, "PROGRAMS": programs}).returncode)


if __name__ == "__main__":
    main()
