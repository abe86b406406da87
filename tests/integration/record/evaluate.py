"""Evaluates the files that every_step left in a directory: evaluate.py DIRECTORY."""
import json
import sys
from pathlib import Path

work = Path(sys.argv[1])


def report(name):
    return json.loads((work / f"{name}.json").read_text())


def code(name):
    return int((work / f"{name}.code").read_text())


def total(name, field):
    return sum(int(axis.get(field, 0)) for axis in report(name)["axes"])


made = {}
for file in work.glob("*.made"):
    axis, steps = file.read_text().split()
    made[axis] = int(steps)

received = total("received", "step_messages")
lost = total("received", "missing_step_messages")
whole = report("whole")
megabytes = (work / "whole.lcm").stat().st_size / 1e6
print(f"{len(made)} axes made {sum(made.values())} steps, {megabytes:.0f} MB of record")
print(f"lcm-logger received {received} messages of steps and lost {lost} between them")
print(f"with the axes' own logs: {total('whole', 'step_messages')} messages, "
      f"{total('whole', 'missing_step_messages')} missing")

assert code("received") == (0 if lost == 0 else 1), "the exit code shows whether something is missing"
assert code("thin_alone") == 1 and total("thin_alone", "missing_step_messages") > 0
assert code("whole") == 0 and whole["complete"], whole
assert {axis["axis"]: int(axis["steps"]) for axis in whole["axes"]} == made
assert int(whole.get("differing", 0)) == 0 and int(whole.get("late", 0)) == 0, whole
assert not any(log["unread"] for log in whole["inputs"]), whole
analysis = report("analysis")
assert {axis["name"]: int(axis["steps"]) for axis in analysis["axes"]} == made
assert not any("missing" in note for note in analysis.get("notes", [])), analysis["notes"]
