#!/usr/bin/env python3
"""Checks that the tests named in docs/promises.md and in the table of papers in core/methods/README.md exist.

Usage: check_promises.py ROOT

A row names folders or files in backticks and, in parentheses behind one, suites or tests in it. A name may be a suite, a
test, or SUITE.TEST; it may end with … for the rest of the name.
"""
import pathlib
import re
import sys

DOCUMENTS = ("docs/promises.md", "core/methods/README.md")
IN_SOURCE = re.compile(r"\b(?:TEST|TEST_F|TEST_P|TYPED_TEST|RC_GTEST_PROP|RC_GTEST_FIXTURE_PROP|INSTANTIATE_TEST_SUITE_P)"
                       r"\(\s*(\w+)\s*,\s*(\w+)")
IN_CMAKE = re.compile(r"\b(?:NAME|add_test\(NAME)\s+([\w.]+)")


def tests_below(path):
    """The names of suites and tests in a folder or file: SUITE, TEST and SUITE.TEST, and what CMake registers."""
    names = set()
    files = [path] if path.is_file() else [p for p in path.rglob("*") if p.is_file()]
    for file in files:
        text = file.read_text(errors="replace") if file.suffix in (".cpp", ".hpp", ".txt", ".cmake") else ""
        if file.suffix in (".cpp", ".hpp"):
            for suite, test in IN_SOURCE.findall(text):
                names |= {suite, test, f"{suite}.{test}"}
        else:
            names |= set(IN_CMAKE.findall(text)) | registered_in_loops(text)
    return names


def registered_in_loops(text):
    """The names that loops such as `foreach(kind a b) add_test(NAME stem.${kind} ...)` and functions register."""
    names = set()
    for stem in re.findall(r"\b([a-z_]+)\.\$\{\w+\}", text):
        names |= {f"{stem}.{word}" for word in re.findall(r"[a-z_0-9]+", text)}
    return names


def matches(name, names):
    return any(known.startswith(name[:-1]) for known in names) if name.endswith("…") else name in names


def breaches(root, document, number, line):
    if not line.startswith("|") or line.count("|") < 3:
        return
    cell = line.split("|")[2]
    for path, _, listed in re.findall(r"`(tests/[^`]+)`( \(([^)]*)\))?", cell):
        place = f"{document}:{number}"
        if not (root / path).exists():
            yield f"{place}: {path} does not exist"
            continue
        known = tests_below(root / path)
        for name in re.findall(r"`([^`]+)`", listed):
            if not matches(name, known):
                yield f"{place}: {path} has no test or suite {name}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    found = [b for document in DOCUMENTS
             for number, line in enumerate((root / document).read_text().splitlines(), 1)
             for b in breaches(root, document, number, line)]
    print("\n".join(found) if found else f"every test that {' and '.join(DOCUMENTS)} name exists")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
