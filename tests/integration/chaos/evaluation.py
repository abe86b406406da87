"""The conditions that a run with any faults must satisfy."""
import dataclasses
import re

from machine import AXES
from record import Record
from story import Chapter

# A late, silent or restarted axis or coordinator may cause these; any other fault is a failure.
FAULTS_OF_LATENESS = {"", "axis-lost", "frames-differ", "frame-late", "emergency-stopped"}
STALL_US = 160_000  # the machine allows for 200 ms
ALARMS = re.compile(r"ERROR: \w+Sanitizer|runtime error:|terminate called|Assertion|check failed|Segmentation", re.I)


@dataclasses.dataclass
class Timed:
    chapter: Chapter
    reaction_ms: float | None = None  # until the first axis left its frames; None: none did
    rest_ms: float | None = None


@dataclasses.dataclass
class Evaluation:
    verify: str = ""
    timed: list = dataclasses.field(default_factory=list)
    failures: list = dataclasses.field(default_factory=list)


def evaluate(machine, story, log, types):
    found = Evaluation(failures=list(story.failures))
    record = Record(log, types)
    found.timed = [timed(chapter, record) for chapter in story.chapters]
    found.verify, is_as_planned = machine.verify(log)
    if not is_as_planned:
        found.failures.append("a step on record is not as planned: " + found.verify.splitlines()[0])
    found.failures += list(partings(story, record)) + list(deaths(machine, story)) + list(alarms(machine))
    found.failures += [f"{chapter.injected.text}: the machine answers with {chapter.fault}"
                       for chapter in story.chapters if chapter.fault not in FAULTS_OF_LATENESS]
    return found


def timed(chapter, record):
    since = chapter.injected.at_us
    reaction = record.reaction_us(since, chapter.watched_us)
    if reaction is None:
        return Timed(chapter)
    axes = [axis for axis in AXES if f"axis-{axis}" != chapter.injected.killed]
    rest = record.rest_us(reaction, axes)
    return Timed(chapter, (reaction - since) / 1000, None if rest is None else (rest - since) / 1000)


def partings(story, record):
    """Yields epochs that axes without a fault ended with different frames. A stall of the host counts as a fault."""
    for epoch, ends in record.ends().items():
        last_us = max(run.start_us for run in ends.values())
        hit = set().union(*(chapter.injected.hit for chapter in story.chapters
                            if chapter.injected.at_us - 1_000_000 <= last_us <= chapter.over_us))
        spared = {axis: run for axis, run in ends.items() if f"axis-{axis}" not in hit
                  and record.longest_silence_us(axis, last_us - 1_000_000, last_us + 1_000_000) < STALL_US}
        if len({(run.frame, run.tail) for run in spared.values()}) > 1:
            listed = ", ".join(f"{axis} frame {run.frame}{' tail' * run.tail}" for axis, run in sorted(ends.items()))
            yield f"epoch {epoch}: axes without a fault are a frame apart: {listed}"


def deaths(machine, story):
    """Yields each end of a process that the test did not cause."""
    asked = [chapter.injected.killed for chapter in story.chapters if chapter.injected.killed]
    for name, how in re.findall(r"(\S+) ((?:ended with code|was ended by signal) \d+)", machine.log("supervisor")):
        if how == "was ended by signal 9" and name in asked:
            asked.remove(name)
        else:
            yield f"{name} {how} by itself: {machine.log(name)[-500:]}"


def alarms(machine):
    for process in ("supervisor", "coordinator", *(f"axis-{axis}" for axis in AXES)):
        for alarm in ALARMS.findall(machine.log(process)):
            yield f"{process} reports: {alarm}"
