"""The programs that run against each mutant, the quickest first."""
from dataclasses import dataclass, field

PROGRAMS = """
  unit_protocol unit_axis unit_motion unit_step unit_coordinator
  property_axis property_clock property_motion papers_lai papers_spielauer papers_methods property_step
  unit_states
""".split()
SIMULATION = "lockstep-simtest"
TARGETS = [*PROGRAMS, SIMULATION]
SEEDS_AT_A_TIME = 25


@dataclass
class Step:
    name: str
    arguments: list
    seconds: float = 0.0
    reaches: set = field(default_factory=set)

    def command(self, folder):
        return ["nice", "-n", "5", folder / self.name.split()[0], *self.arguments]


def steps(runs):
    units = [Step(name, ["--gtest_brief=1", "--gtest_fail_fast"]) for name in PROGRAMS]
    seeds = [Step(f"{SIMULATION} {first}", ["--faults", "all", "--seed", str(first), "--runs", str(SEEDS_AT_A_TIME)])
             for first in range(1, runs, SEEDS_AT_A_TIME)]
    return [*units[:-1], *seeds[:4], units[-1], *seeds[4:]]
