#!/usr/bin/env python3
"""Prints what viewers of the page cost, as a table of Markdown: CPU of the server, CPU of the machine's processes beside
it, and bytes for each viewer, at rest and in motion.

Usage: load.py ROOT PROGRAMS [SECONDS]    SECONDS: for each row, by default 20
"""
import pathlib
import sys

sys.dont_write_bytecode = True
from machine import served  # noqa: E402
from process import cpu_s, memory_bytes  # noqa: E402
from streams import Stream, read_all  # noqa: E402
from viewers import begin_motion  # noqa: E402

VIEWERS = (0, 1, 50)
SETTLE_S = 3


def machine_pids(machine):
    """The coordinator and the axes, by the directory that they were started with."""
    mark = f"LOCKSTEP_STATE={machine.work / 'state'}".encode()
    found = []
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if (process / "comm").read_text().startswith(("lockstep-coordi", "lockstep-axis")) and \
                    mark in (process / "environ").read_bytes():
                found.append(int(process.name))
        except OSError:
            pass  # it has ended
    return found


def row(machine, client, count, what, seconds):
    streams = [Stream(client) for _ in range(count)]
    read_all(streams, SETTLE_S)  # the whole state comes first
    for stream in streams:
        stream.bytes = stream.events = 0
    pids = machine_pids(machine)
    server, others = cpu_s([machine.server.pid]), cpu_s(pids)
    read_all(streams, seconds)
    server, others = (cpu_s([machine.server.pid]) - server) / seconds, (cpu_s(pids) - others) / seconds
    memory = memory_bytes(machine.server.pid) / 1e6
    each = max(count, 1) * seconds
    per_viewer = f"{sum(s.events for s in streams) / each:.1f} | {sum(s.bytes for s in streams) / each / 1e3:.1f}" if count else "– | –"
    print(f"| {what} | {count} | {100 * server:.1f} | {100 * others:.0f} | {per_viewer} | {memory:.0f} |", flush=True)
    for stream in streams:
        stream.close()
    client.await_state(lambda s: s["viewers"] == 0)


def main():
    seconds = float(sys.argv.pop()) if len(sys.argv) > 3 else 20
    with served() as (machine, client):
        print("| machine | viewers | `lockstep-web`, % of a core | coordinator and axes, % of a core | events/s for each "
              "viewer | kB/s for each viewer | memory of `lockstep-web`, MB |\n|---|---|---|---|---|---|---|")
        for count in VIEWERS:
            row(machine, client, count, "at rest", seconds)
        begin_motion(client)
        for count in VIEWERS:
            row(machine, client, count, "in motion", seconds)


if __name__ == "__main__":
    main()
