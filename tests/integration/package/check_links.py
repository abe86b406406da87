#!/usr/bin/env python3
"""Checks that each relative link of the documents in a folder leads to a file or a folder.

Usage: check_links.py FOLDER
"""
import pathlib
import re
import sys

LINK = re.compile(r"\]\(([^)#\s]+)(?:#[^)]*)?\)")
EXAMPLE = re.compile(r"```.*?```|`[^`]*`", re.DOTALL)


def broken_links(folder):
    for document in sorted(folder.rglob("*.md")):
        for target in LINK.findall(EXAMPLE.sub("", document.read_text())):
            if "://" not in target and not (document.parent / target).exists():
                yield f"{document.relative_to(folder)}: no {target}"


def main():
    folder = pathlib.Path(sys.argv[1])
    if not any(folder.rglob("*.md")):
        sys.exit(f"{folder} has no documents")
    broken = list(broken_links(folder))
    print("\n".join(broken) if broken else "no link is broken")
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
