"""The programs that run against each mutant. run_mutants.py measures them and runs the quick ones first."""
import json
import os
import re
import subprocess
from dataclasses import dataclass, field

PROGRAMS = """
  unit_protocol unit_axis unit_motion unit_step unit_core unit_path unit_gcode unit_coordinator unit_planning
  unit_kinematics unit_methods unit_flight unit_virtual
  property_axis property_clock property_coordinator property_kinematics property_motion property_protocol
  property_gcode property_path property_planners property_step papers_lai papers_spielauer papers_methods unit_states
""".split()
SEEDS_AT_A_TIME = 25
TABLES = {  # the scripts that compare what a program computes with the tables of the documents
    "planners": (["tests/benchmarks/planners/compare", "build", "--check"], "lockstep-planner-times"),
    "reactions": (["tests/benchmarks/reactions/table", "build", "--check"], "lockstep-reactions"),
}


@dataclass
class Step:
    name: str
    command: list  # in the folder of the copy
    environment: dict = field(default_factory=dict)
    seconds: float = 0.0
    reaches: set = field(default_factory=set)


def suites(copy, name):
    """The steps that run a test program, one for each of its suites: most mutants are reached by few suites, and one
    that is quick detects most of them. A suite with parameters ("First/Suite/0.") is one with all its parameters."""
    program = f"build/bin/{name}"
    listed = subprocess.run([program, "--gtest_list_tests"], cwd=copy, capture_output=True, text=True, check=True,
                            env={key: value for key, value in os.environ.items() if not key.startswith("LOCKSTEP_")})
    found = dict.fromkeys(re.sub(r"/\d+$", "/*", line.split(".")[0])
                          for line in listed.stdout.splitlines() if re.match(r"[\w/]+\.", line))
    return [Step(f"{name} {suite}", [program, "--gtest_brief=1", "--gtest_fail_fast", f"--gtest_filter={suite}.*"])
            for suite in found]


def machines(runs):
    """Machines in virtual time with every kind of fault, whose steps are compared with those of steps.txt."""
    return [Step(f"machines {first}", ["tests/simulation/steps", "build", "--first", str(first),
                                       "--runs", str(SEEDS_AT_A_TIME)])
            for first in range(1, runs, SEEDS_AT_A_TIME)]


def kinds_of_machines(copy):
    """The tests of tests/simulation that compare runs of a kind of machine with recorded ones: with jogs, motors ..."""
    listed = subprocess.run(["ctest", "--show-only=json-v1", "-R", "^simulation[.]"], cwd=copy / "build",
                            capture_output=True, text=True, check=True)
    commands = {test["name"]: test["command"] for test in json.loads(listed.stdout)["tests"] if "command" in test}
    return [Step(name, command) for name, command in commands.items() if command[0].endswith("/recorded")]


def steps(copy, runs, without=()):
    """All steps in a copy that is built. `without`: programs and tables that are left out."""
    of_programs = (step for name in PROGRAMS if name not in without for step in suites(copy, name))
    tables = [Step(name, command) for name, (command, _) in TABLES.items() if name not in without]
    return [*of_programs, *machines(runs), *kinds_of_machines(copy), *tables]


def targets(without=()):
    """What the steps need."""
    return [*(name for name in PROGRAMS if name not in without), "lockstep-simtest",
            *(target for name, (_, target) in TABLES.items() if name not in without)]
