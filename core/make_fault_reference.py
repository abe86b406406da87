#!/usr/bin/env python3
"""Writes docs/faults.md, every fault and refusal with its cause and remedies, from the table in core/faults.hpp, in the
words of the shell, from clients/session/remedy_words.hpp.

Usage: make_fault_reference.py ROOT [--check]

--check writes nothing and exits with 1 if docs/faults.md differs from the table.
"""
import argparse
import pathlib
import re
import sys

HEAD = """# Faults and refusals

Made from [core/faults.hpp](../core/faults.hpp) by `core/make_fault_reference.py`: change it there.

A command that is refused changes nothing. A machine in Fault is at rest. `lockstep status` names the fault and its remedies.
Numbers are never reused. [recovery.md](recovery.md) describes what to do step by step.

| number | name | cause | check first | then |
|---|---|---|---|---|
"""
PLAIN = {"Wait": "wait until it has ended", "Again": "give the command again"}
STRING = r'"((?:[^"\\]|\\.)*)"'
ROW = re.compile(rf"X\((\w+), (\d+), {STRING}, {STRING}, {STRING}, (.+)$")


def shell_words(root):
    """The words by the names of the actions."""
    code = (root / "clients/session/remedy_words.hpp").read_text()
    found = dict(re.findall(r'case Remedy::(\w+): return "(.*)";', code))
    return PLAIN | {name: re.sub(r"^(lockstep [^,]+)", r"`\1`", words) for name, words in found.items()}


def with_words(by_hand, words):
    """{run-rest} becomes the words of RunRest."""
    return re.sub(r"\{([a-z-]+)\}", lambda found: words[found[1].title().replace("-", "")], by_hand)


def remedies(code, words):
    steps = [words[step] for step in re.findall(r"Remedy::(\w+)", code)]
    return (" or " if "either" in code else ", ").join(steps)


def table(header, words):
    begin = header.index("#define LOCKSTEP_FAULTS(X)")
    code = re.sub(r"\s*\\\n\s*", " ", header[begin:header.index("// clang-format on", begin)])
    for row in re.split(r" (?=X\(\w+, \d+,)", code)[1:]:
        found = ROW.match(row.strip())
        if not found:
            sys.exit(f"core/faults.hpp: a row that this command cannot read: {row}")
        _, number, name, cause, by_hand, steps = found.groups()
        yield f"| {number} | `{name}` | {cause} | {with_words(by_hand, words)} | {remedies(steps, words)} |\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    given = parser.parse_args()
    header = (given.root / "core/faults.hpp").read_text()
    rows = list(table(header, shell_words(given.root)))
    if len(rows) != len(re.findall(r"(?m)^    X\(\w+, \d+,", header)):
        sys.exit("core/faults.hpp: not every row of the table was read")
    file = given.root / "docs/faults.md"
    made = HEAD + "".join(rows)
    if not given.check:
        file.write_text(made)
    elif not file.exists() or file.read_text() != made:
        sys.exit("docs/faults.md: is not what core/faults.hpp says; run: core/make_fault_reference.py .")


if __name__ == "__main__":
    main()
