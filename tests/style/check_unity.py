#!/usr/bin/env python3
"""Finds names in anonymous namespaces that two files of one library or of one test program define differently:
`make build` compiles several files of a library, and all files of a test program, as one (CMAKE_UNITY_BUILD), where
these names clash.
Usage: check_unity.py ROOT"""
import collections
import pathlib
import re
import sys

ROOTS = ["core", "sim_fpga", "services", "clients", "tests"]
SEPARATE = ["tests/benchmarks/step/many/", "core/axis/following/owner_link.cpp"]


def target_of(path):
    """The library or test program that a file is part of."""
    parts = path.split("/")
    depth = {"core": 1, "sim_fpga": 1, "tests": 3}.get(parts[0], 2)
    return "/".join(parts[:depth])


def names_in(body):
    """The names of the lines that begin a type, a constant or a function, each with its line."""
    for line in body.split("\n"):
        if not re.match(r"[A-Za-z]", line) or line.startswith("template"):
            continue
        found = re.match(r"(?:class|struct|enum class|enum)\s+(\w+)[^;]*$", line) or re.match(r"using (\w+) =", line)
        found = found or re.match(r"[\w:<>,&*\s\[\]]*?\b(k[A-Z]\w*)\b", line)
        if found:
            yield found.group(1), line
            continue
        function = re.match(r"[\w:<>,&*\s\[\]]*?[\s&*]([a-z]\w*)\((.*)", line)
        if function:
            arguments = re.sub(r"\b\w+(?=[,)])", "", function.group(2).split(") ")[0])
            yield f"{function.group(1)}({arguments}", line


def clash(lines):
    """Whether a name clashes. lines: the line of each file that defines it. C++ allows the same alias twice."""
    return len(lines) > 1 and not (len(set(lines.values())) == 1 and min(lines.values()).startswith("using "))


def main():
    root = pathlib.Path(sys.argv[1])
    found = collections.defaultdict(dict)
    for path in sorted(p for folder in ROOTS for p in (root / folder).rglob("*.cpp")):
        name = path.relative_to(root).as_posix()
        if name.startswith(tuple(SEPARATE)):
            continue
        text = path.read_text()
        outer = re.search(r"^namespace ([\w:]+) \{", text, re.M)
        for body in re.findall(r"^namespace \{\n(.*?)^\}  // namespace$", text, re.M | re.S):
            for one, line in names_in(body):
                found[target_of(name), outer.group(1) if outer else "", one][name] = line
    clashes = [(key, lines) for key, lines in sorted(found.items()) if clash(lines)]
    for (_, _, one), files in clashes:
        print(f"{one.split('(')[0]} is in {' and '.join(sorted(files))}: share it, or rename one")
    return 1 if clashes else 0


if __name__ == "__main__":
    sys.exit(main())
