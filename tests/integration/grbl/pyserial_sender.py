"""A sender in a few lines of Python: homes, streams a program by counting characters, falls behind, holds and resumes,
and turns the feed while it streams.

Usage: pyserial_sender.py TERMINAL PROGRAM FOLDER
"""
import collections
import re
import sys
import time

import serial

terminal, program = sys.argv[1:3]
lines = [line.strip() for line in open(program)]
port = serial.Serial(terminal, 115200, timeout=0.01)
received = b""
replies = collections.deque()  # whole lines


def receive():
    global received
    received += port.read(4096)
    *whole, received = received.split(b"\r\n")
    replies.extend(line.decode() for line in whole)


def await_reply(start, seconds=60):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        receive()
        while replies:
            line = replies.popleft()
            assert not line.startswith(("error", "ALARM")), line
            if line.startswith(start):
                return line
    raise AssertionError(f"no '{start}' within {seconds} s")


def status():
    port.write(b"?")
    return await_reply("<")


def await_state(state, seconds=60):
    end = time.monotonic() + seconds
    while not (newest := status()).startswith(f"<{state}"):
        assert time.monotonic() < end, f"{newest} instead of {state}"
        time.sleep(0.05)
    return newest


def stream(to_send, between=lambda answered: None):
    """Sends lines, with never more unanswered characters than the receiver's buffer holds."""
    waiting = collections.deque(to_send)
    on_the_way = collections.deque()
    answered = 0
    while waiting or on_the_way:
        while waiting and sum(on_the_way) + len(waiting[0]) + 1 <= room:
            line = waiting.popleft() + "\n"
            on_the_way.append(len(line))
            port.write(line.encode())
        receive()
        while replies:
            reply = replies.popleft()
            assert not reply.startswith(("error", "ALARM")), f"{reply} to line {answered + 1}"
            if reply == "ok":
                on_the_way.popleft()
                answered += 1
                between(answered)


def at_some(answered):
    """Acts as a person does meanwhile, and as a busy host does."""
    if answered % 500 == 0:  # feed up by 10 % and 1 %, down by 10 %; the spindle's does nothing
        port.write((b"\x91", b"\x93", b"\x92", b"\x99")[answered // 500 % 4])
    if answered == 800:
        time.sleep(1.5)  # the machine rests on the path
    if answered == 1500:
        port.write(b"!")
        while not any(reply.startswith("<Hold:0") for reply in replies):
            port.write(b"?")
            time.sleep(0.1)
            receive()
        port.write(b"\x91\x91\x91~")  # the feed: 130 %


port.write(b"\x18")
await_reply("Grbl 1.1")
await_state("Alarm")
port.write(b"$I\n")
room = int(re.search(r"\[OPT:\w*,\d+,(\d+)\]", await_reply("[OPT:")).group(1))
await_reply("ok")
assert room >= 1024, room
port.write(b"$H\n")
await_reply("ok", 120)
await_state("Idle")
begun = time.monotonic()
stream(lines, at_some)
print(f"{len(lines)} lines accepted in {time.monotonic() - begun:.1f} s")
end = await_state("Idle", 120)
assert "MPos:20.000,60.000,40.000" in end, end
port.write(b"\x90")
print(f"and run in {time.monotonic() - begun:.1f} s: {end}")

port.write(b"G91 G0 X100 F6000\n")
await_reply("ok")
await_state("Run")
time.sleep(0.6)
port.write(b"\x18")
await_reply("Grbl 1.1")
where = await_state("Idle")
x = float(re.search(r"MPos:([\d.]+)", where).group(1))
assert 20 < x < 120, where
print(f"a reset in motion: {where}")
stream(["G90", "G0 X20 Y20", "G4 P0.1"])
assert "MPos:20.000,20.000" in await_state("Idle")
