"""The record of the run, as far as it is needed here: what each axis ran, and where it said it was."""
import dataclasses
import struct

SYNC = 0xEDA1DA01
FRAME_US = 230_000


class Reader:
    """LCM's encoding: big-endian, texts with their length and a zero at the end."""

    def __init__(self, data):
        self.data, self.at = data, 8  # behind the type's fingerprint

    def take(self, layout):
        values = struct.unpack_from(">" + layout, self.data, self.at)
        self.at += struct.calcsize(">" + layout)
        return values if len(values) > 1 else values[0]

    def text(self):
        length = self.take("i")
        self.at += length
        return self.data[self.at - length:self.at - 1].decode()


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
    """What an axis said of itself."""
    axis: str
    tick_us: int
    at_rest: bool


def _run(data):
    reader = Reader(data)
    reader.take("q")
    reader.text()
    axis = reader.text()
    incarnation, _, epoch, frame, tail, start, _, _, _, _, cut = reader.take("qqqqbqqqqqb")
    return Run(axis, incarnation, epoch, frame, bool(tail), bool(cut), start)


def _state(data):
    reader = Reader(data)
    _, tick = reader.take("qq")
    reader.text()
    axis = reader.text()
    _, _, velocity, _ = reader.take("qddd")
    return State(axis, tick, velocity == 0)


def events(path):
    """Channel and data of each event of an LCM log."""
    with open(path, "rb") as log:
        while header := log.read(28):
            sync, _, _, channel, size = struct.unpack(">IqqiI", header)
            if sync != SYNC:
                raise ValueError(f"{path}: damaged before byte {log.tell()}")
            yield log.read(channel).decode(), log.read(size)


class Record:
    def __init__(self, path):
        self.runs, self.states = [], []
        for channel, data in events(path):
            if channel.endswith("_RUN"):
                self.runs.append(_run(data))
            elif channel.endswith("_POSITION"):
                self.states.append(_state(data))

    def reaction_us(self, since, until):
        """When the first axis left its frames for a tail, or ceased its pulses, in that time. None: none did."""
        tails = [run.start_us for run in self.runs if run.tail and since <= run.start_us < until]
        cut = {run.axis for run in self.runs if run.cut and since - FRAME_US <= run.start_us < until}
        ceased = [self.rest_us(since, [axis]) for axis in cut]
        return min(tails + [at for at in ceased if at is not None], default=None)

    def rest_us(self, since, axes):
        """When the last of these axes first said it is at rest, from that time on. None: one never did."""
        rests = [min((s.tick_us for s in self.states if s.axis == axis and s.tick_us >= since and s.at_rest),
                     default=None) for axis in axes]
        return None if None in rests else max(rests)

    def longest_silence_us(self, axis, since, until):
        """Between an axis's states, which it makes every 10 ms."""
        ticks = [state.tick_us for state in self.states if state.axis == axis and since <= state.tick_us < until]
        return max((after - before for before, after in zip(ticks, ticks[1:])), default=until - since)

    def ends(self):
        """Of each epoch: where each axis came to in it, (frame, in its tail, cut short), and when it began the last."""
        last = {}
        for run in self.runs:
            if run.epoch:
                last.setdefault(run.epoch, {})[run.axis] = run
        return last
