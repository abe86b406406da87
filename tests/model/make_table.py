#!/usr/bin/env python3
"""Writes the numbers of states stored into the tables of tests/model/README.md.

usage: ctest --test-dir build -C Long -L 'model|long' -R ^model && tests/model/make_table.py build

With cmake -DLOCKSTEP_LONG_MODEL=ON the tests include the longest searches. The numbers of searches that are not in the
log stay as they are.
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
    "takeover": "a standby claims the machine",
}
COLUMNS = {
    "and_stop_2axes": "2 axes, f = 2",
    "frames_of_1_2axes": "2 axes, f = 1",
    "frames_of_1_and_s_2_2axes": "2 axes, f = 1, s = 2",
    "frames_of_5_2axes": "2 axes, f = 5",
    "late_checks_2axes": "2 axes, f = 3, e = 1",
    "touch_2axes": "2 axes, f = 2, touch",
    "and_stop_3axes": "3 axes, f = 2",
    "touch_3axes": "3 axes, f = 2, touch",
    "frames_of_3_3axes": "3 axes, f = 3",
    "frames_of_5_3axes": "3 axes, f = 5",
    "frames_of_1_3axes": "3 axes, f = 1",
    "frames_of_1_and_s_2_3axes": "3 axes, f = 1, s = 2",
    "late_checks_3axes": "3 axes, f = 3, e = 1",
    "and_stop_4axes": "4 axes, f = 2",
}
BEGIN, END = "<!-- states: begin -->\n", "<!-- states: end -->"


def states_by_test(log):
    """The number of states by test, for tests that passed."""
    found, name, states = {}, None, None
    for line in log.splitlines():
        if begun := re.search(r" Testing: (\S+)$", line):
            name, states = begun[1], None
        elif stored := re.search(r"(\d+) states, stored", line):
            states = int(stored[1])
        elif line == "Test Passed." and name and states and name.startswith("model."):
            found[name.removeprefix("model.")] = states
    return found


def states_in(table):
    """The number of states by test, from an existing table."""
    keys = {words: key for key, words in CLASSES.items()}
    columns = {title: column for column, title in COLUMNS.items()}
    head, _, *rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in table.strip().splitlines()]
    return {f"{keys[row[0]]}_{columns[title]}": int(cell.replace(",", ""))
            for row in rows for title, cell in zip(head[1:], row[1:]) if cell}


def table_of(states):
    columns = [column for column in COLUMNS if any(name.endswith("_" + column) for name in states)]
    lines = ["| class, and stop | " + " | ".join(COLUMNS[column] for column in columns) + " |",
             "|---" * (len(columns) + 1) + "|"]
    for key, words in CLASSES.items():
        cells = [f"{states[f'{key}_{column}']:,}" if f"{key}_{column}" in states else "" for column in columns]
        lines.append("| " + " | ".join([words, *cells]) + " |")
    return "\n".join(lines) + "\n"


def main():
    log = pathlib.Path(sys.argv[1], "Testing/Temporary/LastTest.log").read_text(errors="replace")
    states = states_by_test(log)
    if not states:
        sys.exit("no results in the log: run ctest -L model first")
    readme = pathlib.Path(__file__).with_name("README.md")
    before, rest = readme.read_text().split(BEGIN)
    old, after = rest.split(END)
    readme.write_text(before + BEGIN + table_of({**states_in(old), **states}) + END + after)


if __name__ == "__main__":
    main()
