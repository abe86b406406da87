#!/usr/bin/env python3
"""A machine that is up, in its own network, while a program of Node drives its page in a browser.

Usage: page_on_a_machine.py ROOT PROGRAMS COMMAND...    PROGRAMS: the folder of lockstep and lockstep-web
MACHINE_NAME in the environment names the machine; otherwise it has a name of its own. EXAMPLE names the machine's file in
deploy/examples, and SLOT_US the length of its slots.
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
    example = os.environ.get("EXAMPLE", "three-axis")
    slot_us = int(os.environ.get("SLOT_US", "20000"))
    with Machine(root, programs, example, os.environ.get("MACHINE_NAME"), slot_us) as machine:
        sys.exit(subprocess.run(command, env={**machine.env, "PROGRAMS": programs}).returncode)


if __name__ == "__main__":
    main()
