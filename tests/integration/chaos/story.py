"""The course of a run: what was done to the machine, how it answered, and how it was brought back."""
import dataclasses
import time

from faults import Injected
from machine import NEVER_ENDED


@dataclasses.dataclass
class Chapter:
    injected: Injected
    phase: str = ""           # how the machine was found afterwards
    fault: str = ""           # the name of its fault; empty: none
    job: str = ""             # how the job ended that was running
    remedies: list = dataclasses.field(default_factory=list)
    watched_us: int = 0       # until then the machine was left to itself
    over_us: int = 0


class Story:
    SETTLE_S = 30    # for the machine to come to an end of what it does: a failure beyond
    RUNS_ON_S = 1.5  # a machine that has not minded a fault is seen moving for so long, then stopped

    def __init__(self, machine, now_us, quiet):
        self.machine, self.now_us, self.quiet = machine, now_us, quiet
        self.begin_us = now_us()
        self.chapters, self.failures = [], []
        self.is_over = False  # the machine cannot be used any more

    def expect_done(self, what, ended):
        code, _, said = ended
        if code != 0:
            self.fail(f"lockstep {what}: exit code {code}: {said}")
        return code == 0

    def fail(self, text):
        self.failures.append(text)
        self.is_over = True

    def round(self, chaos):
        """A job, a fault, and the way back."""
        self.bring_back()
        if self.is_over:
            return
        job = self.machine.begin_job()
        self._wait_for(lambda status: status.get("phase") != "Idle" or job.poll() is not None)
        time.sleep(chaos.rng.uniform(0.2, 2.5))
        chapter = Chapter(chaos.strike())
        self.chapters.append(chapter)
        self._watch(chapter, job)
        code, told, said = self.machine.end(job)
        if code == NEVER_ENDED:
            self.fail(f"{chapter.injected.text}: lockstep run: {said}")
        chapter.job = told.get("outcome") or (said.splitlines()[0] if said else "no report")
        chapter.over_us = self.now_us()

    def _watch(self, chapter, job):
        time.sleep(self.RUNS_ON_S)
        chapter.watched_us = self.now_us()
        status = self._wait_for(lambda found: found.get("phase") not in (None, "Waiting", "Stopping"))
        chapter.phase = status.get("phase", "not heard")
        chapter.fault = status.get("fault", {}).get("name", "")
        if chapter.phase in ("Holding", "Paused") and chapter.injected.kind == "hold":
            self._remedy("resume")
            time.sleep(self.RUNS_ON_S)
        if job.poll() is None and self.machine.status().get("phase") in ("Running", "Holding", "Paused"):
            self.machine.call("stop")

    def _wait_for(self, is_there):
        """The first status that is as asked for."""
        deadline = time.monotonic() + self.SETTLE_S
        while time.monotonic() < deadline:
            status = self.machine.status()
            if is_there(status):
                return status
            time.sleep(0.05)
        self.fail(f"the machine does not come to an end: {self.machine.status()}")
        return {}

    def bring_back(self):
        """To where a job can begin."""
        self._remedy_all()
        if self.chapters and not self.quiet:
            self._tell(self.chapters[-1])

    def _remedy_all(self):
        """As a user does: what the machine says decides what is done."""
        status = self._wait_for(lambda found: found.get("phase") in ("Idle", "Fault", "Holding", "Paused")
                                and all(axis.get("present") for axis in found["axes"]))
        if status.get("phase") in ("Holding", "Paused"):
            self._remedy("stop")
            status = self._wait_for(lambda found: found.get("phase") in ("Idle", "Fault"))
        if status.get("phase") == "Fault":
            self._remedy("reset")
            status = self._wait_for(lambda found: found.get("phase") == "Idle")
        if not self.is_over and not all(axis.get("homed") for axis in status["axes"]):
            self._remedy("home")

    def _remedy(self, word):
        if self.chapters:
            self.chapters[-1].remedies.append(word)
        self.expect_done(word, self.machine.call(word))

    def _tell(self, chapter):
        at = (chapter.injected.at_us - self.begin_us) / 1e6
        print(f"{at:7.2f} s  {chapter.injected.text:<52} {chapter.phase}{' ' * bool(chapter.fault)}{chapter.fault}; "
              f"job {chapter.job}{'; then ' * bool(chapter.remedies)}{', '.join(chapter.remedies)}", flush=True)
