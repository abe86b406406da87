#!/usr/bin/env python3
"""Writes the numbers of states stored into the tables of tests/model/README.md.

usage: ctest --test-dir build -L model && tests/model/make_table.py build
"""
import pathlib
import re
import sys

CLASSES = {
    "no_fault": "no fault",
    "coordinator_crash": "the coordinator crashes, also within a multicast",
    "axis_crash": "an axis crashes",
    "axis_mute": "no message from an axis arrives",
    "axis_deaf": "no message to an axis arrives",
    "coordinator_link": "link between coordinator and axis, both ways",
    "coordinator_to_axis": "the same, from the coordinator only",
    "axis_to_coordinator": "the same, to the coordinator only",
    "coordinator_mute": "no message from the coordinator arrives",
    "coordinator_deaf": "no message to the coordinator arrives",
    "coordinator_cut_off": "neither from it nor to it",
    "axis_link": "link between two axes",
    "axis_link_one_way": "the same, one way",
    "axis_loss": "a message of an axis is lost",
    "coordinator_loss": "a message of the coordinator is lost",
    "axis_veto": "an axis vetoes for its own reasons",
    "axis_stall": "an axis stalls for up to s slots",
    "axis_long_stall": "an axis stalls for longer",
    "coordinator_stall": "the coordinator stalls for up to s slots",
    "coordinator_long_stall": "the coordinator stalls for longer",
    "all_stall": "all processes stall for up to s slots",
    "all_long_stall": "all processes stall for longer",
}
COLUMNS = ["and_stop_2axes", "and_stop_3axes", "frames_of_1_2axes", "frames_of_1_and_s_2_2axes", "frames_of_5_2axes",
           "late_checks_2axes", "frames_of_1_3axes", "frames_of_5_3axes"]
BEGIN, END = "<!-- states: begin -->\n", "<!-- states: end -->"


def states_by_test(log):
    found = {}
    for part in re.split(r"\n-{20,}\n(?=\d+/\d+ Testing: )", log):
        name = re.search(r"Testing: model\.(\S+)", part)
        states = re.search(r"(\d+) states, stored", part)
        if name and states and "Test Passed." in part + log[log.find(part) + len(part):][:200]:
            found[name[1]] = int(states[1])
    return found


def table(states):
    lines = ["| class, and stop | 2 axes | 3 axes | f = 1 | f = 1, s = 2 | f = 5 | e = 1, f = 3 | 3 axes, f = 1 | 3 axes, f = 5 |",
             "|---|---|---|---|---|---|---|---|---|"]
    for key, words in CLASSES.items():
        cells = [f"{states[f'{key}_{column}']:,}" if f"{key}_{column}" in states else "" for column in COLUMNS]
        lines.append("| " + " | ".join([words, *cells]) + " |")
    return "\n".join(lines) + "\n"


def main():
    log = pathlib.Path(sys.argv[1], "Testing/Temporary/LastTest.log").read_text(errors="replace")
    states = states_by_test(log)
    if not states:
        sys.exit("no results in the log: run ctest -L model first")
    readme = pathlib.Path(__file__).with_name("README.md")
    text = readme.read_text()
    before, rest = text.split(BEGIN)
    readme.write_text(before + BEGIN + table(states) + END + rest.split(END)[1])


if __name__ == "__main__":
    main()
