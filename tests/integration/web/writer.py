#!/usr/bin/env python3
"""The server is a writer like others: it takes the machine's lease with its first command, is refused while another
has it, takes it over when it is told to, and gives it back.

Usage: writer.py ROOT PROGRAMS
"""
import subprocess
import sys
import time

sys.dont_write_bytecode = True
from client import Events, expect, refused  # noqa: E402
from machine import served  # noqa: E402

LONG = "G21 G90\n" + "G1 X100 F600\nG1 X10\n" * 40 + "M2\n"


def is_mine(state):
    return state["writer"] is not None and state["writer"]["is_this_server"]


def is_free(state):
    return state["writer"] is None


def check_first_command(client):
    expect(is_free(client.state()), "a server that was given no command is no writer")
    refused(client.command("resume"), 409, "nothing-to-do")
    writer = client.await_state(is_mine)["writer"]
    expect(writer["name"] == f"the page at http://127.0.0.1:{client.port}/", writer)
    client.await_state(is_free)  # no viewer is left that could give more commands
    expect(client.command("hold").status == 409 and is_free(client.state()), "a hold needs no lease")


def check_watched(machine, client):
    """A page that is open keeps the machine while its job runs, but not at rest: a shell may jog in between."""
    events = Events(client)
    expect(client.command("home").status == 200, "not begun")
    expect(is_mine(client.await_state(lambda s: s["mode"] == "Homing")), "it has no lease for its own job")
    client.await_state(lambda s: s["mode"] == "Idle" and all(axis["homed"] for axis in s["axes"].values()))
    client.await_state(is_free, seconds=30)
    machine.lockstep("jog", "X+", "--distance", "0.5")
    client.await_state(lambda s: client.command("override", {"feed_percent": 100}).status == 200 and is_mine(s))
    expect(client.command("give").status == 200 and is_free(client.state()), "not given back")
    events.close()


def check_other_writer(machine, client):
    program = machine.work / "long.gcode"
    program.write_text(LONG)
    env = {**machine.env, "LOCKSTEP_WRITER": "anna"}
    other = subprocess.Popen([machine.programs / "lockstep", "run", program], env=env,
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    state = client.await_state(lambda s: s["mode"] == "Running" and s["writer"])
    expect(state["writer"]["name"] == "anna" and not state["writer"]["is_this_server"], state["writer"])
    for verb, body in (("override", {"feed_percent": 50}), ("jog", {"jogs": [{"axis": "X", "velocity": 5}]}), ("reset", {})):
        problem = refused(client.command(verb, body), 409, "writer-held")
        expect(problem["value"] == state["writer"] and "{take}" in problem["remedy"], problem)
    expect(client.command("hold").status == 200, "a hold is everybody's")
    client.await_state(lambda s: s["hold"] and s["hold"]["state"] == "held")
    refused(client.command("resume"), 409, "writer-held")
    expect(client.command("take").status == 200 and is_mine(client.state()), "not taken over")
    expect(client.command("resume").status == 200, "no resume")
    expect(client.command("stop").status == 200, "no stop")
    expect(other.wait(30) != 0, "a job that was stopped is not done")
    client.await_state(lambda s: s["mode"] == "Idle" and is_free(s))


def check_taken_while_jogging(machine, client):
    """If another client takes the lease, the jog ends, and its key begins no other jog."""
    jog = {"jogs": [{"axis": "X", "velocity": 5}], "press": 1}
    for jog["press"] in range(1, 100):  # a host that stalls ends a jog, too
        answer = client.command("jog", jog)
        if answer.status == 200 and answer.json()["jogging"]:
            break
    taken = subprocess.Popen([machine.programs / "lockstep", "override", "--feed", "100", "--take"], stdout=subprocess.DEVNULL,
                             env={**machine.env, "LOCKSTEP_WRITER": "anna"})
    for _ in range(2000):
        answer = client.command("jog", jog)
        if answer.status != 200 or not answer.json()["jogging"]:
            break
        time.sleep(0.02)
    expect(answer.status == 409 or not answer.json()["jogging"], f"it jogs on: {answer.body}")
    expect(taken.wait(30) == 0, "not taken over")
    client.await_state(lambda s: s["mode"] == "Idle" and s["axes"]["X"]["at_rest"] and not is_mine(s))
    client.command("jog", {"jogs": [], "press": jog["press"]})
    refused(client.command("jog", jog), 409, "jog-over")


def check_end(machine, client):
    """Within its renewal period the server learns that another client took the lease, and asks for it again."""
    client.await_state(lambda s: client.command("override", {"feed_percent": 100}).status == 200 and is_mine(s))
    machine.end_server()
    status = machine.lockstep("status").stdout
    expect("writer:" not in status, f"a server that has ended gives the lease back: {status}")


def main():
    with served() as (machine, client):
        check_first_command(client)
        check_watched(machine, client)
        check_other_writer(machine, client)
        check_taken_while_jogging(machine, client)
        check_end(machine, client)


if __name__ == "__main__":
    main()
