#!/usr/bin/env python3
"""Checks that NOTICE names every library of the programs, and that the image's context has all files of the package.

Usage: check_notices.py ROOT
"""
import pathlib
import re
import sys

FOLDERS = ("core", "sim_fpga", "idl", "services", "clients")
USED = re.compile(r"find_package\((\w+)|find_library\(\w+ (\w+)")
NOT_LINKED = {"Java", "Python3", "dds_security_auth"}  # tools, and a part of CycloneDDS


def libraries(root):
    for folder in FOLDERS:
        for file in (root / folder).rglob("CMakeLists.txt"):
            yield from (one or other for one, other in USED.findall(file.read_text()))


def installed(root):
    for files in re.findall(r"install\(FILES ([^)]*?)\s+(?:RENAME|DESTINATION)", (root / "deploy/package.cmake").read_text()):
        yield from (name for name in files.split() if "$" not in name)


def is_in_context(name, allowed):
    return any(name == entry or name.startswith(entry + "/") for entry in allowed)


def main():
    root = pathlib.Path(sys.argv[1])
    notice = (root / "NOTICE").read_text().lower()
    found = [f"NOTICE: does not name {name}" for name in sorted(set(libraries(root)) - NOT_LINKED)
             if not re.search(rf"\b{name.lower()}\b", notice)]
    allowed = [line[1:] for line in (root / ".dockerignore").read_text().splitlines() if line.startswith("!")]
    found += [f".dockerignore: leaves out {name}, which the package installs" for name in installed(root)
              if not is_in_context(name, allowed)]
    found += [f"deploy/package.cmake: {name} does not exist" for name in installed(root) if not (root / name).exists()]
    print("\n".join(found) if found else "NOTICE names every library")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
