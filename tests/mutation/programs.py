"""The programs that run against each mutant. run_mutants.py measures them and runs the quick ones first."""
from dataclasses import dataclass, field

PROGRAMS = """
  unit_protocol unit_axis unit_motion unit_step unit_core unit_path unit_gcode unit_coordinator unit_planning
  property_axis property_clock property_motion property_gcode property_path property_planners property_step
  papers_lai papers_spielauer papers_methods unit_states
""".split()
PARTS = {"property_path": 8, "unit_states": 4}  # the programs that take longest run in so many parts
QUICKEST = {"property_gcode": "GcodeMeanings.*", "property_path": "PathFramesOfPrograms.*"}  # tests that also run alone
SEEDS_AT_A_TIME = 25
TABLES = {  # the scripts that compare what a program computes with the tables of the documents
    "planners": (["tests/benchmarks/planners/compare", "build", "--check"], "lockstep-planner-times"),
    "reactions": (["tests/benchmarks/reactions/table", "build", "--check"], "lockstep-reactions"),
}
TARGETS = [*PROGRAMS, "lockstep-simtest", *(target for _, target in TABLES.values())]


@dataclass
class Step:
    name: str
    command: list  # in the folder of the copy
    environment: dict = field(default_factory=dict)
    seconds: float = 0.0
    reaches: set = field(default_factory=set)


def parts(name):
    """The steps that run a test program, one for each part."""
    command, count = [f"build/bin/{name}", "--gtest_brief=1", "--gtest_fail_fast"], PARTS.get(name, 1)
    if count == 1:
        return [Step(name, command)]
    return [Step(f"{name} {n + 1}", command, {"GTEST_TOTAL_SHARDS": str(count), "GTEST_SHARD_INDEX": str(n)})
            for n in range(count)]


def machines(runs):
    """Machines in virtual time with every kind of fault, whose steps are compared with those of steps.txt."""
    return [Step(f"machines {first}", ["tests/simulation/steps", "build", "--first", str(first),
                                       "--runs", str(SEEDS_AT_A_TIME)])
            for first in range(1, runs, SEEDS_AT_A_TIME)]


def steps(runs):
    alone = [Step(tests.split(".")[0], [f"build/bin/{name}", f"--gtest_filter={tests}"])
             for name, tests in QUICKEST.items()]
    tables = [Step(name, command) for name, (command, _) in TABLES.items()]
    return [*(step for name in PROGRAMS for step in parts(name)), *alone, *machines(runs), *tables]
