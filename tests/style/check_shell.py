#!/usr/bin/env python3
"""Checks every shell script with shellcheck. It finds, for example, assertions that cannot fail: under set -e a command
behind ! never ends a script.

Usage: check_shell.py ROOT

.shellcheckrc has the exceptions. Exit codes: 0 nothing found, 1 else.
"""
import pathlib
import re
import subprocess
import sys

FOLDERS = [".ci", "clients", "core", "deploy", "docs", "idl", "services", "sim_fpga", "tests"]


def is_script(path):
    if path.is_symlink() or not path.is_file() or "node_modules" in path.parts:
        return False
    with path.open("rb") as file:
        return re.match(rb"#!.*\b(ba)?sh\n", file.readline(100)) is not None


def main():
    root = pathlib.Path(sys.argv[1])
    scripts = [path for folder in FOLDERS for path in sorted((root / folder).rglob("*")) if is_script(path)]
    result = subprocess.run(["shellcheck", *map(str, scripts)], cwd=root)
    if result.returncode == 0:
        print(f"{len(scripts)} scripts are in order")
    return 1 if result.returncode else 0


if __name__ == "__main__":
    sys.exit(main())
