#!/usr/bin/env python3
"""Writes the reference of a machine's file, docs/configuration.md, from the comments of machine.proto.

Usage: make_reference.py ROOT [--check]

--check writes nothing and exits with 1 if the reference differs from machine.proto.
"""
import argparse
import pathlib
import re
import sys

KINDS = {"string": "text", "double": "number", "bool": "true or false", "int32": "whole number", "int64": "whole number",
         "uint32": "whole number"}
HEAD = """# The machine's file, key by key

Made from [idl/proto/machine.proto](../idl/proto/machine.proto) by `idl/proto/make_reference.py`: change it there.

"""


def blocks(lines):
    """The proto's messages and enums: name, comment, and their own lines."""
    comment, found, block = [], [], None
    for line in lines:
        head = re.match(r"(message|enum) (\w+) \{", line)
        if head:
            block = (head.group(1), head.group(2), comment, [])
            found.append(block)
        elif line == "}":
            block, comment = None, []
        elif block:
            block[3].append(line.strip())
        elif line.startswith("//"):
            comment.append(line[2:].strip())
        elif not line:
            comment = []
    return found


def entries(lines):
    """Each key or name of a block with its kind and comment."""
    comment = []
    for line in lines:
        key = re.match(r"(?:(optional|repeated) )?(?:(\w+) )?(\w+) = \d+;", line)
        if key:
            yield key.group(1), key.group(2), key.group(3), " ".join(comment)
            comment = []
        elif line.startswith("//"):
            comment.append(line[2:].strip())


def kind_text(how, kind, enums):
    several = ", any number of times" if how == "repeated" else ""
    if kind in enums:
        return "one of " + ", ".join(f"`{name}`" for _, _, name, _ in entries(enums[kind])) + several
    return (KINDS[kind] if kind in KINDS else f"block, see [{kind}](#{kind.lower()})") + several


def reference(text):
    lines = text.splitlines()
    intro = " ".join(line[2:].strip() for line in lines[: lines.index('syntax = "proto3";')])
    found = blocks(lines)
    enums = {name: own for sort, name, _, own in found if sort == "enum"}
    out = HEAD + intro + "\n"
    for sort, name, comment, own in found:
        out += f"\n## {name}\n\n" + (" ".join(comment) + "\n\n" if comment else "")
        for how, kind, key, about in entries(own):
            what = f" ({kind_text(how, kind, enums)})" if sort == "message" else ""
            out += f"- `{key}`{what}" + (f": {about}" if about else "") + "\n"
    return out


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    given = parser.parse_args()
    made = reference((given.root / "idl/proto/machine.proto").read_text())
    file = given.root / "docs/configuration.md"
    if not given.check:
        file.write_text(made)
    elif not file.exists() or file.read_text() != made:
        sys.exit(f"{file}: differs from idl/proto/machine.proto; run: idl/proto/make_reference.py .")


if __name__ == "__main__":
    main()
