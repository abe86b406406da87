#!/usr/bin/env python3
"""Fifty viewers at once, and others that do not read or that vanish: the server drops those, the fifty get everything,
and unread data does not make the server's memory grow.

Usage: viewers.py ROOT PROGRAMS
"""
import socket
import struct
import sys
import time

sys.dont_write_bytecode = True
from client import expect  # noqa: E402
from machine import served  # noqa: E402
from process import cpu_s, memory_bytes  # noqa: E402
from streams import Stream, read_all  # noqa: E402

LONG = "G21 G90\n" + "G1 X100 Y40 F600\nG1 X10 Y5\n" * 200 + "M2\n"
MOST_GROWTH_BYTES = 30_000_000
IDLE_S = 4
MOST_IDLE_SHARE = 0.25


def check_idle(machine):
    """The server hardly uses the CPU while it has no viewer and nothing moves."""
    before = cpu_s([machine.server.pid])
    time.sleep(IDLE_S)
    used = cpu_s([machine.server.pid]) - before
    expect(used < MOST_IDLE_SHARE * IDLE_S, f"the idle server used {used} s of processor time in {IDLE_S} s")


def begin_motion(client):
    client.command("home")
    client.await_state(lambda s: s["mode"] == "Idle" and all(axis["homed"] for axis in s["axes"].values()))
    expect(client.request("POST", "/api/program", LONG).status == 200 and client.command("run").status == 200, "not begun")
    client.await_state(lambda s: s["mode"] == "Running")


def check_stalled(machine, client):
    """The deltas that the server keeps for a viewer that does not read, and the kernel's buffer, are bounded."""
    readers = [Stream(client) for _ in range(50)]
    stalled = [Stream(client, buffer=4096) for _ in range(5)]
    client.await_state(lambda s: s["viewers"] == 55)
    before = memory_bytes(machine.server.pid)
    end = time.monotonic() + 150
    while client.state()["viewers"] > 50:
        expect(time.monotonic() < end, f"viewers that do not read are still there: {client.state()['viewers']}")
        had = [stream.events for stream in readers]
        read_all(readers, 5)
        least = min(stream.events - n for stream, n in zip(readers, had))
        expect(least > 0, "a viewer gets nothing while others do not read")
    growth = memory_bytes(machine.server.pid) - before
    expect(growth < MOST_GROWTH_BYTES, f"what is not read takes {growth} bytes")
    for stream in stalled + readers:
        stream.close()
    client.await_state(lambda s: s["viewers"] == 0)


def check_vanished(client):
    """A browser that is killed resets its connections."""
    streams = [Stream(client) for _ in range(20)]
    client.await_state(lambda s: s["viewers"] == 20)
    for stream in streams:
        stream.socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
        stream.close()
    client.await_state(lambda s: s["viewers"] == 0)


def main():
    with served() as (machine, client):
        check_idle(machine)
        begin_motion(client)
        check_stalled(machine, client)
        check_vanished(client)
        state = client.state()
        expect(state["mode"] == "Running" and not state["alarms"], f"the machine noticed its viewers: {state['alarms']}")


if __name__ == "__main__":
    main()
