#!/usr/bin/env python3
"""Checks which folder includes which, against layers.toml, and that no folder has too many files.

Usage: check_layers.py ROOT         Prints each breach as file:line: what; exits 1 where there is one.
       check_layers.py --self-test  Checks that a forbidden include, a cycle and a crowded folder are found.
"""
import graphlib
import pathlib
import re
import sys
import tempfile
import tomllib

SOURCES = (".hpp", ".cpp", ".inc")
INCLUDE = re.compile(r'#include (?:"([\w/.-]+)"|<(lockstep)/\w+_t\.hpp>)')
LCM_TYPES = "idl/lcm"  # generated: <lockstep/NAME_t.hpp>


def included(line):
    """The folder and the file that a line includes, by their paths from the root; None for a library's."""
    match = INCLUDE.match(line)
    if not match:
        return None
    path = match.group(1)
    return (path.rpartition("/")[0], path) if path else (LCM_TYPES, LCM_TYPES)


def sources(root, top):
    for path in sorted((root / top).rglob("*")):
        if path.suffix in SOURCES:
            yield path


def is_in(folder, pattern):
    """"a/**" stands for a and every folder below it."""
    return folder == pattern or pattern.endswith("/**") and (folder + "/").startswith(pattern[:-2])


def allowed_for(folder, table):
    return [entry for key in table if is_in(folder, key) for entry in table[key]]


def include_breaches(root, layers):
    table = layers["may_include"]
    for path in (p for top in layers["checked"] for p in sources(root, top)):
        name = path.relative_to(root).as_posix()
        folder = path.parent.relative_to(root).as_posix()
        if folder not in table:
            yield f"{name}:1: layers.toml does not have the folder {folder}"
            continue
        allowed = allowed_for(folder, table)
        for number, line in enumerate(path.read_text().splitlines(), 1):
            target = included(line)
            if target and target[0] != folder and not any(is_in(one, entry) for one in target for entry in allowed):
                yield f"{name}:{number}: {folder} may not include {target[0]} (tests/style/layers.toml)"


def circles(layers):
    """Finds folders that depend on each other in a circle. An entry for one file is no dependency of folders."""
    table = layers["may_include"]
    folders = [key for key in table if not key.endswith("/**")]
    graph = {
        folder: [o for entry in allowed_for(folder, table) for o in folders if is_in(o, entry) and o != folder]
        for folder in folders
    }
    try:
        graphlib.TopologicalSorter(graph).prepare()
    except graphlib.CycleError as error:
        yield "layers.toml: folders include each other in a circle: " + " <- ".join(error.args[1])


def crowded_folders(root, layers):
    data = tuple(layers["data"])
    folders = {}
    for path in (p for top in layers["counted"] for p in (root / top).rglob("*")):
        if path.is_file() and path.suffix not in data and "__pycache__" not in path.parts:
            folders.setdefault(path.parent, []).append(path)
    for folder, files in sorted(folders.items()):
        if len(files) > layers["most_files"]:
            name = folder.relative_to(root).as_posix()
            yield f"{name}: {len(files)} files; the limit is {layers['most_files']}: split it by what the files do"


def breaches(root, layers):
    return [*include_breaches(root, layers), *circles(layers), *crowded_folders(root, layers)]


def load(root):
    return tomllib.loads((root / "tests/style/layers.toml").read_text())


def self_test():
    def found(table, files):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in files.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            return breaches(root, tomllib.loads(table))

    head = 'checked = ["a", "b"]\ncounted = ["a", "b"]\nmost_files = 2\ndata = [".svg"]\n[may_include]\n'
    a_to_b = {"a/x.cpp": '#include <vector>\n#include "b/y.hpp"\n', "b/y.hpp": ""}
    b_to_a = {"a/x.hpp": "", "b/y.hpp": '#include "a/x.hpp"\n'}
    allowed = head + 'a = ["b"]\nb = []\n'
    expected = [
        (allowed, a_to_b, None),
        (allowed, a_to_b | b_to_a, "b/y.hpp:1: b may not include a"),
        (head + "a = []\nb = []\n", a_to_b, "a/x.cpp:2: a may not include b"),
        (head + 'a = ["b/y.hpp"]\nb = []\n', a_to_b, None),
        (head + 'a = ["b"]\nb = ["a"]\n', a_to_b | b_to_a, "in a circle"),
        (head + '"a/**" = ["b/**"]\na = []\n"a/c" = []\n"b/d" = []\n', {"a/c/x.cpp": '#include "b/d/y.hpp"\n'}, None),
        (head + '"a/**" = ["b"]\na = []\n"a/c" = []\n', {"a/c/x.cpp": '#include "b/d/y.hpp"\n'}, "may not include b/d"),
        (head + "a = []\n", {"b/y.hpp": ""}, "does not have the folder b"),
        (head + "a = []\nb = []\n", {"a/x.hpp": "#include <lockstep/run_t.hpp>\n"}, "a may not include idl/lcm"),
        (allowed, a_to_b | {"b/1.svg": "", "b/2.svg": "", "b/3.svg": ""}, None),
        (allowed, a_to_b | {"b/1.cpp": "", "b/2.cpp": ""}, "b: 3 files"),
    ]
    for table, files, what in expected:
        result = found(table, files)
        if (what is None) != (not result) or not all(what in breach for breach in result):
            sys.exit(f"expected {what!r} in:\n{table}{files}\nfound {result}")
    print(f"{len(expected)} cases are as expected")


def main():
    if sys.argv[1] == "--self-test":
        return self_test()
    root = pathlib.Path(sys.argv[1]).resolve()
    layers = load(root)
    found = breaches(root, layers)
    print("\n".join(found) if found else f"{len(layers['may_include'])} folders are in order")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
