"""The course of a run: the faults, the machine's reactions, and its recovery."""
import dataclasses
import time

from faults import Injected
from machine import NEVER_ENDED


@dataclasses.dataclass
class Chapter:
    injected: Injected
    phase: str = ""           # of the machine afterwards
    fault: str = ""           # the name of its fault; empty: none
    job: str = ""             # the end of the running job
    remedies: list = dataclasses.field(default_factory=list)
    watched_us: int = 0       # no further fault was injected before this
    over_us: int = 0
    is_printed: bool = False


class Story:
    SETTLE_S = 30    # for the machine to finish its action; longer is a failure
    TRIES = 6
    RUNS_ON_S = 1.5  # how long a machine that a fault has not stopped is observed before it is stopped

    def __init__(self, machine, now_us, quiet):
        self.machine, self.now_us, self.quiet = machine, now_us, quiet
        self.begin_us = now_us()
        self.chapters, self.failures = [], []
        self.is_over = False  # the machine cannot be used any more

    def expect_done(self, what, ended):
        code, _, output = ended
        if code != 0:
            self.fail(f"lockstep {what}: exit code {code}: {output}")
        return code == 0

    def fail(self, text):
        self.failures.append(text)
        self.is_over = True

    def round(self, chaos):
        """A job, a fault, and the recovery."""
        self.bring_back()
        if self.is_over:
            return
        job = self.machine.begin_job()
        self._wait_for(lambda status: status.get("phase") != "Idle" or job.poll() is not None)
        chaos.turn_overrides()
        time.sleep(chaos.rng.uniform(0.2, 2.5))
        chapter = Chapter(chaos.strike())
        self.chapters.append(chapter)
        self._watch(chapter, job)
        code, report, output = self.machine.end(job)
        if code == NEVER_ENDED:
            self.fail(f"{chapter.injected.text}: lockstep run: {output}")
        chapter.job = report.get("outcome") or (output.splitlines()[0] if output else "no report")
        chapter.over_us = self.now_us()

    def _watch(self, chapter, job):
        time.sleep(self.RUNS_ON_S)
        chapter.watched_us = self.now_us()
        status = self._wait_for(lambda found: found.get("phase") not in (None, "Waiting", "Stopping"))
        chapter.phase = status.get("phase", "not received")
        chapter.fault = status.get("fault", {}).get("name", "")
        if chapter.phase in ("Holding", "Paused") and chapter.injected.kind == "hold":
            self._remedy("resume")
            time.sleep(self.RUNS_ON_S)
        if job.poll() is None and self.machine.status().get("phase") in ("Running", "Holding", "Paused"):
            self.machine.call("stop")

    def _wait_for(self, is_there):
        """The first status that satisfies the condition."""
        deadline = time.monotonic() + self.SETTLE_S
        while time.monotonic() < deadline:
            status = self.machine.status()
            if is_there(status):
                return status
            time.sleep(0.05)
        self.fail(f"the machine does not reach the expected state: {self.machine.status()}")
        return {}

    def bring_back(self):
        """Brings the machine to where a job can begin, as a user does: its state determines the commands."""
        for _ in range(self.TRIES):
            word = self._what_next(self._wait_for(self._is_settled))
            if self.is_over or not word:
                break
            self._remedy(word)
        else:
            self.fail(f"the machine cannot be brought back: {self.machine.status()}")
        if self.chapters and not self.chapters[-1].is_printed and not self.quiet:
            self._tell(self.chapters[-1])

    @staticmethod
    def _is_settled(status):
        return (status.get("phase") in ("Idle", "Fault", "Holding", "Paused")
                and all(axis.get("present") for axis in status["axes"]))

    @staticmethod
    def _what_next(status):
        """The next command; empty if a job can begin."""
        phase = status.get("phase")
        if phase != "Idle":
            return "reset" if phase == "Fault" else "stop"
        return "" if all(axis.get("homed") for axis in status["axes"]) else "home"

    def _remedy(self, word):
        """Gives a command. It may fail if the host stalls meanwhile; then the caller repeats it."""
        code, _, _ = self.machine.call(word)
        if self.chapters:
            self.chapters[-1].remedies.append(word if code == 0 else word + " (failed)")

    def run_to_the_end(self):
        """Runs a job without a fault to its end."""
        for _ in range(self.TRIES):
            self.bring_back()
            if self.is_over or self.machine.end(self.machine.begin_job(lines=10))[0] == 0:
                return
        self.fail("a job without a fault did not complete")

    def _tell(self, chapter):
        chapter.is_printed = True
        at = (chapter.injected.at_us - self.begin_us) / 1e6
        print(f"{at:7.2f} s  {chapter.injected.text:<52} {chapter.phase}{' ' * bool(chapter.fault)}{chapter.fault}; "
              f"job {chapter.job}{'; then ' * bool(chapter.remedies)}{', '.join(chapter.remedies)}", flush=True)
