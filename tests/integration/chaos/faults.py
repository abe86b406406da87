"""The faults. Each kind is a function: it injects the fault, waits for its end, and returns a description."""
import dataclasses
import os
import signal
import time

from machine import AXES


@dataclasses.dataclass
class Injected:
    kind: str
    text: str
    at_us: int                # of machine time, which is the host's monotonic clock
    hit: frozenset            # the affected processes: these may end at other places
    killed: str = ""


EVERYBODY = frozenset(("coordinator", *(f"axis-{axis}" for axis in AXES)))


def now_us():
    return time.monotonic_ns() // 1000


class Chaos:
    """Injects faults into a machine, drawn from a seed. Each kind is drawn once before any is repeated."""

    def __init__(self, machine, network, rng):
        self.machine, self.network, self.rng = machine, network, rng
        self.deck = []
        self.kinds = [self.kill_axis, self.kill_coordinator,
                      self.stall_briefly, self.stall_axis, self.stall_coordinator,
                      self.lose_packets, self.cut_axis, self.deafen_axis, self.mute_axis, self.cut_coordinator,
                      self.hold, self.stop, self.emergency_stop]

    def strike(self):
        if not self.deck:
            self.deck = self.rng.sample(self.kinds, len(self.kinds))
        return self.deck.pop()()

    def _axis(self):
        return f"axis-{self.rng.choice(AXES)}"

    def _ms(self, low, high):
        return self.rng.randint(low, high)

    # ---- Processes

    def _kill(self, process):
        injected = Injected("kill -9 " + process.split("-")[0], f"kill -9 {process}", now_us(), frozenset((process,)),
                            process)
        os.kill(self.machine.processes()[process], signal.SIGKILL)
        return injected

    def kill_axis(self):
        return self._kill(self._axis())

    def kill_coordinator(self):
        return self._kill("coordinator")

    def _stall(self, process, kind, ms):
        pid = self.machine.processes()[process]
        injected = Injected(kind, f"{process} stalls for {ms} ms", now_us(), frozenset((process,)))
        os.kill(pid, signal.SIGSTOP)
        time.sleep(ms / 1000)
        os.kill(pid, signal.SIGCONT)
        return injected

    def stall_briefly(self):
        return self._stall(self.rng.choice(sorted(EVERYBODY)), "stall of 20 to 60 ms", self._ms(20, 60))

    def stall_axis(self):
        return self._stall(self._axis(), "stall of an axis", self._ms(300, 1200))

    def stall_coordinator(self):
        return self._stall("coordinator", "stall of the coordinator", self._ms(300, 1200))

    # ---- Network

    def _lose(self, kind, hosts, directions, probability, ms):
        what = f"{probability:.0%} of the packets lost" if probability < 1 else kind
        hit = frozenset(hosts)
        text = f"{', '.join(sorted(hosts)) if hit != EVERYBODY else 'everybody'}: {what} for {ms} ms"
        injected = Injected(kind, text, now_us(), hit)
        for host in hosts:
            self.network.drop(host, directions, probability)
        time.sleep(ms / 1000)
        for host in hosts:
            self.network.heal(host)
        return injected

    def lose_packets(self):
        share = self.rng.uniform(0.05, 0.5)
        return self._lose("packets lost", sorted(EVERYBODY), ("INPUT",), share, self._ms(300, 1500))

    def cut_axis(self):
        return self._lose("axis cut off", (self._axis(),), ("INPUT", "OUTPUT"), 1, self._ms(50, 1500))

    def deafen_axis(self):
        return self._lose("axis deaf", (self._axis(),), ("INPUT",), 1, self._ms(50, 1500))

    def mute_axis(self):
        return self._lose("axis mute", (self._axis(),), ("OUTPUT",), 1, self._ms(50, 1500))

    def cut_coordinator(self):
        return self._lose("coordinator cut off", ("coordinator",), ("INPUT", "OUTPUT"), 1, self._ms(50, 1500))

    # ---- Commands

    def turn_overrides(self):
        """No fault, and no reason to stop: in most rounds feed and rapid are changed while the job runs."""
        if self.rng.random() < 0.7:
            self.machine.call("override", "--feed", str(self.rng.randint(20, 200)), "--rapid",
                              str(self.rng.randint(20, 100)))

    def _command(self, word, hit=frozenset()):
        injected = Injected(word, f"lockstep {word}", now_us(), hit)
        code, _, output = self.machine.call(word)
        if code != 0:
            injected.text += f" (refused: {output.splitlines()[0]})" if output else " (refused)"
        return injected

    def hold(self):
        return self._command("hold")

    def stop(self):
        return self._command("stop")

    def emergency_stop(self):
        return self._command("estop", EVERYBODY)
