#!/usr/bin/env python3
"""A machine is watched, moved and stopped over HTTP; jogs end with their page; bad input is refused; many viewers.

Usage: page_server.py ROOT PROGRAMS
"""
import json
import sys
import threading
import time

sys.dont_write_bytecode = True
from client import Events, expect, refused  # noqa: E402
from machine import served  # noqa: E402

PROGRAM = "G21 G90\nG1 X40 Y30 F1500\nG1 X60 Y20\nG0 X10 Y10\nM2\n"
LONG = "G21 G90\n" + "G1 X100 F600\nG1 X10\n" * 20 + "M2\n"


def check_session(client, tokens):
    for role, token in tokens.items():
        answer = client.request("POST", "/api/session", {"token": token}, token="")
        cookie = answer.headers["set-cookie"]
        expect(answer.json() == {"role": role} and "HttpOnly" in cookie and "SameSite=Strict" in cookie, cookie)
        shown = client.get("/api/session", token="", headers={"Cookie": cookie.split(";")[0]})
        expect(shown.json() == {"role": role}, shown.body)
    refused(client.get("/api/state", token=""), 401, "no-session")
    refused(client.get("/api/state", token="wrong"), 401, "no-session")
    refused(client.command("stop", token=tokens["view"]), 403, "view-only")
    refused(client.get("/api/state", headers={"Host": "evil.example"}), 403, "foreign-host")
    refused(client.command("stop", headers={"Origin": "http://evil.example"}), 403, "foreign-origin")


def check_headers(client):
    page = client.get("/", token="")
    expect(page.status == 200 and page.headers["content-type"].startswith("text/html"), page.headers)
    policy = page.headers["content-security-policy"]
    expect("default-src 'none'" in policy and "unsafe" not in policy, policy)
    for name in ("x-content-type-options", "referrer-policy"):
        expect(name in page.headers, f"no {name}")
    expect("access-control-allow-origin" not in page.headers, "CORS is allowed")
    expect(client.get("/", token="", headers={"If-None-Match": page.headers["etag"]}).status == 304, "no 304")
    refused(client.get("/../../etc/passwd", token=""), 404, "unknown-path")


def check_bad_input(client):
    json_type = {"Content-Type": "application/json"}
    refused(client.request("POST", "/api/commands/hold", "{", headers=json_type), 400, "bad-json")
    refused(client.request("POST", "/api/commands/hold", "[" * 10000, headers=json_type), 400, "bad-json")
    refused(client.request("POST", "/api/commands/hold", "{}", headers={"Content-Type": "text/plain"}), 415, "not-json")
    refused(client.command("hold", {"now": 1}), 400, "unknown-member")
    refused(client.command("fly"), 404, "unknown-verb")
    refused(client.get("/api/commands/hold"), 405, "wrong-method")
    refused(client.command("override", {"feed_percent": 1000}), 422, "out-of-range")
    refused(client.command("jog", {"jogs": [{"axis": "Q", "velocity": 1}]}), 422, "out-of-range")
    refused(client.request("POST", "/api/commands/hold", b" " * 20000, headers=json_type), 413, "too-long")
    refused(client.request("POST", "/api/program", b"\x89PNG\r\n\x1a\n\0\0"), 415, "not-text")
    refused(client.request("POST", "/api/program", b"G1", headers={"Content-Type": "image/png"}), 415, "not-text")
    refused(client.request("POST", "/api/program", b"(x)\n" * 25_000_000), 413, "too-long")
    wrong = client.request("POST", "/api/program?name=w.gcode", "G21\nG1 X9999 F100\nG1 Y-50\nHALLO\n")
    refused(wrong, 422, "bad-program")
    lines = [error["line"] for error in wrong.json()["errors"]]
    expect(2 in lines and 4 in lines, lines)
    refused(client.get("/api/program"), 404, "no-program")
    refused(client.command("run"), 409, "no-program")


def check_replay(client):
    key = {"Idempotency-Key": "once"}
    expect(client.command("override", {"feed_percent": 90}, headers=key).status == 200, "not accepted")
    refused(client.command("override", {"feed_percent": 100}, headers=key), 409, "replayed")
    expect(client.await_state(lambda s: s["override"]["feed_percent"] == 90), "")
    client.command("override", {"feed_percent": 100})


def check_motion(client):
    events = Events(client)
    expect(events.next()[0] == "stream" and events.next()[0] == "state", "a stream begins with its name and the state")
    refused(client.command("mdi", {"line": "G0 X10"}), 409, "not-homed")
    expect(client.command("home").json()["job"] == 1, "not begun")
    client.await_state(lambda s: s["mode"] == "Idle" and all(axis["homed"] for axis in s["axes"].values()))

    loaded = client.request("POST", "/api/program?name=plate.gcode", PROGRAM).json()
    expect(loaded["name"] == "plate.gcode" and loaded["lines"] == 5 and loaded["blocks"] == 3, loaded)
    expect(client.get("/api/program").body.decode() == PROGRAM, "another text")
    path = client.get("/api/program/path?points=100")
    expect(len(path.body) == 16 * int(path.headers["lockstep-points"]) == 64, path.headers)
    refused(client.command("run", {"program": loaded["id"] + 1}), 409, "other-program")
    job = client.command("run", {"program": loaded["id"]}).json()["job"]
    while not (events.state and (events.state.get("job") or {}).get("outcome") == "Done" and events.state["job"]["number"] == job):
        events.next()
    expect(events.state["job"]["name"] == "plate.gcode" and events.state["job"]["blocks_done"] == 3, events.state["job"])
    expect(abs(events.state["axes"]["X"]["position"] - 10) < 0.02, events.state["axes"])

    last_id, before = events.id, events.state
    events.close()
    expect(client.command("override", {"rapid_percent": 50}).status == 200, "")
    again = Events(client, last_id)
    again.state = before
    expect(again.next()[0] == "stream" and again.next()[0] == "delta", "the stream does not go on behind its last event")
    while again.state["override"]["rapid_percent"] != 50:
        again.next()
    again.close()
    client.command("override", {"rapid_percent": 100})


def check_hold(client):
    client.request("POST", "/api/program?name=long", LONG)
    expect(client.command("run").status == 200, "not begun")
    client.await_state(lambda s: s["mode"] == "Running" and s["axes"]["X"]["velocity"] > 0)
    refused(client.command("run"), 409, "busy")
    expect(client.command("hold").status == 200, "no hold")
    client.await_state(lambda s: s["hold"] and s["hold"]["state"] == "held")
    refused(client.command("mdi", {"line": "G0 X1"}), 409, "held")
    expect(client.command("resume").status == 200, "no resume")
    client.await_state(lambda s: s["mode"] == "Running")
    expect(client.command("stop").status == 200, "no stop")
    client.await_state(lambda s: s["mode"] == "Idle" and s["job"]["outcome"] == "Stopped")
    refused(client.command("stop"), 409, "nothing-to-do")


def check_values(client):
    expect(client.command("touch", {"axes": {"X": 0}}).status == 200, "no touch")
    x = client.state()["axes"]["X"]["position"]
    origin = client.state()["offsets"]["systems"]["G54"]["origin"]["X"]
    expect(abs(origin - x) < 0.02, (origin, x))
    expect(client.command("mdi", {"line": "G0 X5"}).status == 200, "no mdi")
    client.await_state(lambda s: s["mode"] == "Idle" and abs(s["axes"]["X"]["position"] - x - 5) < 0.02)
    expect(client.get("/api/mdi").json()["lines"][-1] == {"line": "G0 X5", "accepted": True}, "no history")
    refused(client.command("mdi", {"line": "G0 X99999"}), 422, "bad-program")
    expect(client.command("tool", {"number": 3, "offset": {"X": 1.5}, "diameter": 6}).status == 200, "no tool")
    expect(client.state()["tools"]["3"] == {"pocket": 0, "offset": {"X": 1.5, "Y": 0.0}, "diameter": 6.0}, client.state()["tools"])
    expect(client.command("tool", {"number": 3, "remove": True}).status == 200 and client.state()["tools"] == {}, "not removed")
    expect(client.command("offset", {"system": "G54", "origin": {"X": 0}}).status == 200, "no offset")


def check_mdi(client):
    """Modes and parameters hold from line to line, and are shown; M2, a program and a reset end them."""
    def give(line):
        answer = client.command("mdi", {"line": line})
        expect(answer.status == 200, f"{line}: {answer.body}")
        job = answer.json()["job"]
        if job is not None:
            client.await_state(lambda s: s["mode"] == "Idle" and s["job"]["number"] == job and s["job"]["outcome"] == "Done"
                               and all(axis["at_rest"] for axis in s["axes"].values()))
        return answer.json()

    begin = client.state()["modes"]
    expect("G90" in begin and "G54" in begin and "G21" in begin, begin)
    expect(give("#1=5 #<x>=3")["job"] is None, "a parameter alone begins no job")
    give("G0 X#1 Y#<x>")
    client.await_state(lambda s: abs(s["axes"]["X"]["position"] - 5) < 0.02 and abs(s["axes"]["Y"]["position"] - 3) < 0.02)
    answer = give("G91 G55 F600")
    expect({"G91", "G55", "F600"} <= set(answer["modes"]), answer)
    expect(client.state()["modes"] == answer["modes"] == client.get("/api/mdi").json()["modes"], client.state())
    expect(client.state()["offsets"]["active"] == "G55", client.state()["offsets"])
    give("G1 X1")
    give("X1")
    client.await_state(lambda s: abs(s["axes"]["X"]["position"] - 7) < 0.02)
    refused(client.command("mdi", {"line": "o100 repeat [3]"}), 422, "bad-program")
    give("M2")
    expect("G90" in client.state()["modes"] and "G54" in client.state()["modes"], client.state()["modes"])
    give("G91")
    client.request("POST", "/api/program?name=short", "G0 X5\nM2\n")
    expect(client.command("run").status == 200, "not begun")
    client.await_state(lambda s: s["mode"] == "Idle" and "G90" in s["modes"])


def check_jog(client):
    """A jog moves while it is renewed. Without renewal or page it stops by itself. A late renewal starts nothing."""
    streams = [Events(client), Events(client)]
    own, other = (stream.next()[1]["stream"] for stream in streams)
    jog = {"jogs": [{"axis": "X", "velocity": 20}], "stream": own, "press": 0}
    for _ in range(200):  # a host that stalls for longer than a jog lasts without a renewal ends it
        answer = client.command("jog", jog)
        if answer.status != 200 or not answer.json()["jogging"]:
            jog["press"] += 1
        if client.state()["axes"]["X"]["velocity"] > 0:
            break
        time.sleep(0.05)
    else:
        expect(False, "it does not move")
    refused(client.command("jog", {"jogs": [{"axis": "Y", "velocity": 5}], "stream": other}), 409, "busy")
    client.await_state(lambda s: s["mode"] == "Idle" and s["axes"]["X"]["at_rest"], 10)
    refused(client.command("jog", jog), 409, "jog-over")
    for stream in streams:
        stream.close()

    events = Events(client)
    name = events.next()[1]["stream"]
    jog = {"jogs": [{"axis": "X", "velocity": -20}], "stream": name, "press": 1}
    expect(client.command("jog", jog).status == 200, "no jog")
    events.close()
    client.await_state(lambda s: s["viewers"] == 0, 10)
    client.await_state(lambda s: s["mode"] == "Idle" and s["axes"]["X"]["at_rest"], 10)
    for closed in (name, "none"):
        refused(client.command("jog", {**jog, "stream": closed, "press": 2}), 409, "stream-closed")

    jog = {"jogs": [{"axis": "X", "velocity": 10}], "press": 7}
    expect(client.command("jog", jog).status == 200, "no jog")
    expect(client.command("jog", {"jogs": [], "press": 7}).json()["jogging"] is False, "not released")
    refused(client.command("jog", jog), 409, "jog-over")
    client.await_state(lambda s: s["mode"] == "Idle" and s["axes"]["X"]["at_rest"], 10)


def check_stop(client):
    time.sleep(0.5)  # the last jog brakes
    expect(client.command("run").status == 200, "not begun")
    client.await_state(lambda s: s["mode"] == "Running")
    expect(client.command("estop").status == 200, "no emergency stop")
    state = client.await_state(lambda s: s["mode"] == "Fault")
    alarm = state["alarms"][0]
    expect(alarm["code"] == "emergency-stopped" and alarm["remedy"] and alarm["severity"] == "fault", alarm)
    refused(client.command("run"), 409, "in-fault")
    expect(client.command("reset").status == 200, "no reset")
    client.await_state(lambda s: s["mode"] == "Idle")


def check_viewers(client):
    """Fifty viewers read at the same time."""
    streams = [Events(client) for _ in range(50)]
    for stream in streams:
        while stream.state is None:
            stream.next()
    client.await_state(lambda s: s["viewers"] == 50)
    client.command("home")
    readers = [threading.Thread(target=lambda s=stream: [s.next() for _ in range(20)]) for stream in streams]
    for reader in readers:
        reader.start()
    for reader in readers:
        reader.join(60)
        expect(not reader.is_alive(), "a viewer gets nothing")
    for stream in streams:
        stream.close()
    client.await_state(lambda s: s["viewers"] == 0 and s["mode"] == "Idle", 30)


def check_loss(machine, client):
    events = Events(client)
    while events.state is None:
        events.next()
    machine.lockstep("down")
    while events.state["mode"] != "Unreachable":
        events.next()
    refused(client.command("home"), 503, "unreachable")
    machine.lockstep("up")
    while events.state["mode"] == "Unreachable":
        events.next()
    events.close()


def main():
    with served() as (machine, client):
        for check in (lambda c: check_session(c, machine.tokens), check_headers, check_bad_input, check_replay, check_motion,
                      check_hold, check_values, check_mdi, check_jog, check_stop, check_viewers, lambda c: check_loss(machine, c)):
            begin = time.monotonic()
            check(client)
            print(f"{getattr(check, '__name__', '')}: {time.monotonic() - begin:.1f} s", flush=True)
        tokens = dict(machine.tokens)
        machine.end_server()
        machine.serve()
        expect(machine.tokens == tokens, "the tokens do not outlive the server")
    print(json.dumps({"result": "done"}))


if __name__ == "__main__":
    main()
