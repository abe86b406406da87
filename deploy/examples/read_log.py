#!/usr/bin/env python3
"""Reads a Lockstep log with LCM's own Python types, and prints the position and step rate of each axis.

    export PYTHONPATH=build/share/lockstep/python
    python3 deploy/examples/read_log.py run.lcm --every 0.5

The functions can also be used in a notebook:

    import read_log
    steps = [batch for batch in read_log.messages("run.lcm") if isinstance(batch, read_log.step_batch_t)]
"""
import argparse
import struct
import sys
from collections import defaultdict
from itertools import accumulate

try:
    import lockstep
    from lockstep import axis_position_t, step_batch_t
except ImportError:
    sys.exit("read_log: no module 'lockstep': set PYTHONPATH to share/lockstep/python beside the programs,\n"
             "in the build tree: export PYTHONPATH=build/share/lockstep/python")

TYPES = {kind._get_packed_fingerprint(): kind
         for kind in vars(lockstep).values() if hasattr(kind, "_get_packed_fingerprint")}
EVENT = struct.Struct(">IQQII")  # sync word, number, time in us, lengths of channel and data
SYNC = 0xEDA1DA01


def messages(path):
    """Yields every message in the log, decoded, in order. Skips types that are not Lockstep's."""
    with open(path, "rb") as log:
        while header := log.read(EVENT.size):
            if len(header) < EVENT.size:
                sys.exit(f"{path}: ends within an event; the events before it are valid")
            sync, _, _, channel_length, data_length = EVENT.unpack(header)
            if sync != SYNC:
                sys.exit(f"{path}: byte {log.tell() - EVENT.size} begins no event; `lockstep analyze` continues after it")
            log.read(channel_length)
            data = log.read(data_length)
            if data[:8] in TYPES and len(data) == data_length:
                yield TYPES[data[:8]].decode(data)


def step_ticks(batch):
    """Returns the tick of every step of a batch."""
    return [batch.first_tick + sum_of_deltas for sum_of_deltas in accumulate(batch.delta_ticks)]


def rows(path, every_s):
    """Yields (axis, seconds since the log's first position, mm, steps per second) of every axis, each `every_s` s."""
    start, last, made = None, {}, defaultdict(int)
    for message in messages(path):
        if isinstance(message, step_batch_t):
            made[message.axis] += message.count
        if not isinstance(message, axis_position_t):
            continue
        start = message.utime if start is None else start
        since = last.setdefault(message.axis, message.utime)
        if message.utime - since >= every_s * 1e6:
            rate = made.pop(message.axis, 0) * 1e6 / (message.utime - since)
            last[message.axis] = message.utime
            yield message.axis, (message.utime - start) * 1e-6, message.position_mm, rate


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("log", help="written by lcm-logger, or by lockstep simulate --log")
    arguments.add_argument("--every", type=float, default=0.1, metavar="S", help="seconds between rows (default 0.1)")
    given = arguments.parse_args()
    print(f"{'axis':<8}{'time s':>10}{'position mm':>14}{'steps/s':>12}")
    try:
        for axis, time_s, position_mm, rate in rows(given.log, given.every):
            print(f"{axis:<8}{time_s:>10.3f}{position_mm:>14.4f}{rate:>12.0f}")
    except OSError as error:
        sys.exit(f"read_log: {given.log}: {error.strerror}")


if __name__ == "__main__":
    main()
