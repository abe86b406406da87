"""Checks that the simulations together reached everything except what UNREACHED lists.

usage: check_coverage.py UNREACHED COVERAGE.json...

UNREACHED has a line "group: name: reason" for each thing that no run reaches. The program exits with 0 if the runs reached
everything else, and none of these.
"""

import collections
import json
import sys


def read_unreached(path):
    unreached = {}
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            if line.strip() and not line.startswith("#"):
                group, name, because = line.strip().split(": ", 2)
                unreached[group, name] = because
    return unreached


def sum_of(paths):
    counts = collections.Counter()
    for path in paths:
        with open(path, encoding="utf-8") as file:
            for group, names in json.load(file).items():
                for name, times in names.items():
                    counts[group, name] += times
    return counts


def main(unreached_path, *paths):
    unreached = read_unreached(unreached_path)
    counts = sum_of(paths)
    never = sorted(thing for thing, times in counts.items() if times == 0 and thing not in unreached)
    after_all = sorted(thing for thing in unreached if counts[thing] > 0)
    unknown = sorted(thing for thing in unreached if thing not in counts)
    for group, name in never:
        print(f"never: {group}: {name}; add a run that reaches it, or state in {unreached_path} why none can")
    for group, name in after_all:
        print(f"reached after all: {group}: {name}; remove it from {unreached_path}")
    for group, name in unknown:
        print(f"not counted: {group}: {name}; remove it from {unreached_path}")
    reached = sum(times > 0 for times in counts.values())
    print(f"{reached} of {len(counts)} reached, {len(unreached)} out of reach, by {len(paths)} simulations")
    return 1 if never or after_all or unknown else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
