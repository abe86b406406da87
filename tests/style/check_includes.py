#!/usr/bin/env python3
"""Finds files that use a type or a constant of the project and include its header neither directly nor through another
header. `make build` compiles several files as one, which hides this; the preset debug compiles each file alone.
Usage: check_includes.py ROOT"""
import collections
import pathlib
import re
import sys

ROOTS = ["core", "sim_fpga", "services", "clients", "tests"]
GENERATED = "sim_fpga/registers.hpp"  # has constants of its own
DECLARATION = re.compile(
    r"^(?:(?:class|struct|enum|enum class)\s+(\w+)(?:\s+final)?\s*(?::[^;{]*)?\{|using (\w+) =|"
    r"(?:inline |static )*constexpr\s[\w:<>,&*\s\[\]]*?\b(k[A-Z]\w*)\b)", re.M)
# Names that no other library has, either: a constant, or a type of two words.
NAME = re.compile(r"(?<![\w.:>])(?:k[A-Z]\w*|[A-Z][a-z0-9]+[A-Z]\w*)\b")


def without_text(text):
    """The code without comments, strings, directives, enumerators and names of tests."""
    text = re.sub(r'R"(\w*)\(.*?\)\1"', '""', text, flags=re.S)
    text = re.sub(r"//[^\n]*|^#(?:.*\\\n)*.*", "", text, flags=re.M)
    text = re.sub(r'"(?:\\.|[^"\\\n])*"', '""', text)
    text = re.sub(r"^(?:TEST|RC_GTEST)\w*\([^,]*", "", text, flags=re.M)
    return re.sub(r"(\benum (?:class )?\w+[^;{]*)\{[^}]*\}", r"\1{}", text)


def included_by(name, includes):
    """The file and all files that it includes."""
    seen, left = set(), [name]
    while left:
        one = left.pop()
        if one not in seen:
            seen.add(one)
            left += includes.get(one, [])
    return seen


def main():
    root = pathlib.Path(sys.argv[1])
    texts = {p.relative_to(root).as_posix(): p.read_text() for f in ROOTS for p in (root / f).rglob("*.[ch]pp")}
    includes = {name: [beside if (beside := (pathlib.PurePath(name).parent / one).as_posix()) in texts else one
                       for one in re.findall(r'^#include "([^"]+)"', text, re.M)] for name, text in texts.items()}
    code = {name: without_text(text) for name, text in texts.items()}
    words = {name: set(NAME.findall(text)) for name, text in code.items()}
    headers = collections.defaultdict(set)
    for name in texts:
        if name.endswith(".hpp"):
            for found in DECLARATION.finditer(code[name]):
                headers[next(filter(None, found.groups()))].add(name)
    missing = []
    for name in sorted(texts):
        known = included_by(name, includes) - {name}
        if GENERATED in known:
            continue
        named = words[name] - set().union(*(words.get(one, set()) for one in known))
        declared = re.findall(r"\b(?:class|struct|enum|typename|using) (\w+)|\b(k\w+)[\[\]\w]*(?: = |\{)", code[name])
        for word in sorted(named - {one for pair in declared for one in pair}):
            if len(headers[word]) == 1 and name not in headers[word]:
                missing.append(f'{name}: {word}: include "{next(iter(headers[word]))}"')
    for line in missing:
        print(line)
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
