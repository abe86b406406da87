#!/usr/bin/env python3
"""Checks that no type of the wire or of files changes unnoticed: idl/fingerprints.txt has a fingerprint of each file.

Usage: check_idl.py ROOT [--record]

A fingerprint ignores comments, white space, and for what protobuf optimises its code. The check exits with 1 if a
fingerprint or the protocol's number differs from the record, and prints what to decide (idl/README.md has the rules).
--record writes the file again.
"""
import argparse
import hashlib
import pathlib
import re
import sys

RULES = {
    ".idl": "processes of both versions no longer receive each other: raise kProtocol in services/wire/dds/protocol_version.hpp",
    ".lcm": "existing logs can no longer be read: give the type a new name, unless no log with it exists",
    ".proto": "check that no field number changed its meaning or was removed: existing files must stay readable",
}


def fingerprint(path):
    text = re.sub(r"/\*.*?\*/|//[^\n]*|option optimize_for = \w+;", "", path.read_text(), flags=re.S)
    return hashlib.sha256("".join(text.split()).encode()).hexdigest()[:16]


def protocol(root):
    header = (root / "services/wire/dds/protocol_version.hpp").read_text()
    return re.search(r"kProtocol = (\d+);", header).group(1)


def found(root):
    files = [path for path in sorted((root / "idl").rglob("*")) if path.suffix in RULES]
    return {"protocol": protocol(root)} | {path.relative_to(root).as_posix(): fingerprint(path) for path in files}


def breaches(recorded, now):
    for name in sorted(recorded.keys() | now.keys()):
        if recorded.get(name) == now.get(name):
            continue
        what = "is new" if name not in recorded else "is gone" if name not in now else "differs from the record"
        if name == "protocol":
            yield f"protocol: {now[name]}, recorded {recorded.get(name)}"
        else:
            yield f"{name}: {what}; {RULES[pathlib.Path(name).suffix]}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("root", type=pathlib.Path)
    parser.add_argument("--record", action="store_true")
    options = parser.parse_args()
    record = options.root / "idl/fingerprints.txt"
    now = found(options.root)
    if options.record:
        record.write_text("".join(f"{name} {value}\n" for name, value in now.items()))
    recorded = dict(line.split() for line in record.read_text().splitlines())
    wrong = list(breaches(recorded, now))
    print("\n".join(wrong + ["when that is done: tests/style/check_idl.py . --record"]) if wrong else
          f"{len(now) - 1} files are as recorded, protocol {now['protocol']}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
