"""The parts of the record that the test needs: the runs of each axis, and its reported positions."""
import dataclasses
import pathlib
import sys

FRAME_US = 460_000
EXAMPLES = pathlib.Path(__file__).resolve().parents[3] / "deploy" / "examples"


@dataclasses.dataclass
class Run:
    """A frame or tail that an axis's device has run."""
    axis: str
    incarnation: int
    epoch: int
    frame: int
    tail: bool
    cut: bool
    start_us: int


@dataclasses.dataclass
class State:
    """A published state of an axis."""
    axis: str
    tick_us: int
    at_rest: bool


class Record:
    """`types`: the folder of LCM's generated Python types."""

    def __init__(self, path, types):
        sys.path += [str(EXAMPLES), str(types)]
        from lockstep import axis_position_t, run_t
        from read_log import messages
        self.runs, self.states = [], []
        for message in messages(path):
            if isinstance(message, run_t):
                self.runs.append(Run(message.axis, message.incarnation, message.epoch, message.frame,
                                     bool(message.tail), bool(message.cut), message.start_tick))
            elif isinstance(message, axis_position_t):
                self.states.append(State(message.axis, message.tick, message.velocity_steps_per_s == 0))

    def reaction_us(self, since, until):
        """The time at which the first axis began a tail or ceased its pulses, in that time. None if none did."""
        tails = [run.start_us for run in self.runs if run.tail and since <= run.start_us < until]
        cut = {run.axis for run in self.runs if run.cut and since - FRAME_US <= run.start_us < until}
        ceased = [self.rest_us(since, [axis]) for axis in cut]
        return min(tails + [at for at in ceased if at is not None], default=None)

    def rest_us(self, since, axes):
        """The time, from `since` on, at which the last of these axes first reported rest. None if one never did."""
        rests = [min((s.tick_us for s in self.states if s.axis == axis and s.tick_us >= since and s.at_rest),
                     default=None) for axis in axes]
        return None if None in rests else max(rests)

    def longest_silence_us(self, axis, since, until):
        """The longest time between two states of an axis, which publishes one in each slot."""
        ticks = [state.tick_us for state in self.states if state.axis == axis and since <= state.tick_us < until]
        return max((after - before for before, after in zip(ticks, ticks[1:])), default=until - since)

    def ends(self):
        """For each epoch, the last frame or tail that each axis ran."""
        last = {}
        for run in self.runs:
            if run.epoch:
                last.setdefault(run.epoch, {})[run.axis] = run
        return last
