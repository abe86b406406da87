#!/usr/bin/env python3
"""The server does what clients/web/openapi.yaml says: the test requests every path, verb and status of it, every answer
matches its schema, and the server has no other route.

Usage: openapi.py ROOT PROGRAMS
"""
import pathlib
import re
import sys

sys.dont_write_bytecode = True
from client import Events, expect, refused  # noqa: E402
from machine import served  # noqa: E402

PROGRAM = "G21 G90\nG1 X40 Y30 F1500\nM2\n"

# verb: (body that is accepted, bodies that are refused because of their form)
BODIES = {
    "home": ({"axes": ["X", "Y"]}, [{"axes": "X"}, {"axes": [1]}]),
    "run": ({}, [{"program": "1"}, {"program": 1.5}]),
    "hold": ({}, []),
    "resume": ({}, []),
    "stop": ({}, []),
    "estop": ({}, []),
    "reset": ({}, []),
    "override": ({"feed_percent": 100}, [{}, {"feed_percent": 9}, {"rapid_percent": 201}, {"feed_percent": "100"}]),
    "jog": ({"jogs": [], "press": 1, "stream": "a"},
            [{}, {"jogs": [{"axis": "X"}]}, {"jogs": [{"axis": "X", "velocity": 1, "distance": 0}]}, {"jogs": [1]},
             {"jogs": [], "press": 0}, {"jogs": [], "stream": "a" * 65}]),
    "mdi": ({"line": "G0 X20"}, [{}, {"line": ""}, {"line": 1}, {"line": "G" * 1001}]),
    "touch": ({"system": "G55", "axes": {"X": 0}}, [{}, {"axes": {}}, {"axes": {"X": "0"}}]),
    "offset": ({"system": "G55", "origin": {"X": 0}, "rotation_deg": 0}, [{}, {"system": 1}, {"system": "G54", "origin": 1}]),
    "tool": ({"number": 3, "pocket": 1, "offset": {"X": 1}, "diameter": 6},
             [{}, {"number": 0}, {"number": 1, "diameter": -1}, {"number": 1.5}, {"number": 1, "remove": "yes"}]),
    "probe": ({"kind": "touch", "to": {"X": 20}, "feed": 60},
              [{}, {"kind": "hole", "feed": 60}, {"kind": "touch", "to": {}, "feed": 60}, {"kind": "touch", "to": {"X": "1"}, "feed": 60}]),
    "keep": ({"system": "G55", "reads": 1}, [{}, {"system": 1}, {"tool": 0}]),
    "take": ({}, []),
    "give": ({}, []),
}
# One client cannot cause this for certain: a full queue. This machine has no probe: integration.web_page_measures asks for
# the heights of a surface.
NOT_ASKED = {("POST", "/api/commands/{verb}", 429), ("POST", "/api/program", 409), ("GET", "/api/heights", 200)}


def check_routes(root, contract):
    """The routes and verbs of the code are those of the document."""
    source = pathlib.Path(root) / "clients/web"
    rows = re.findall(r'\{"(GET|POST|PUT|DELETE|PATCH)", "(/api/[^"]*)"', (source / "api/api.cpp").read_text())
    plain = {(method, re.sub(r"\{\w+\}", "*", path)) for method, path in contract.operations()}
    expect(rows and set(rows) == plain, f"routes of the code and the document differ: {set(rows) ^ plain}")
    verbs = contract.operations()[("POST", "/api/commands/{verb}")]["parameters"][0]["schema"]["enum"]
    expect(set(verbs) == set(BODIES), f"verbs of the document and of this test differ: {set(verbs) ^ set(BODIES)}")
    schemas = {name.removeprefix("Command_") for name in contract.components["schemas"] if name.startswith("Command_")}
    expect(schemas == set(verbs), f"verbs and their schemas differ: {schemas ^ set(verbs)}")


def check_methods(client, contract):
    for path in contract.document["paths"]:
        methods = {method for method, other in contract.operations() if other == path}
        answer = client.request("PATCH", re.sub(r"\{\w+\}", "hold", path))
        refused(answer, 405, "wrong-method")
        expect(set(answer.headers["allow"].split(", ")) == methods, f"{path}: {answer.headers['allow']}")


def check_verbs(client, contract):
    known = refused(client.command("fly"), 404, "unknown-verb")["limit"]
    expect(set(known.split(", ")) == set(BODIES), f"the server's verbs: {known}")
    for verb, (body, wrong_ones) in BODIES.items():
        expect(contract.is_command(verb, body), f"{verb} {body} is not of its schema")
        for wrong in [*wrong_ones, {**body, "unknown": 1}]:
            expect(not contract.is_command(verb, wrong), f"{verb} {wrong} is of its schema")
            answer = client.command(verb, wrong)
            expect(answer.status in (400, 422), f"{verb} {wrong}: {answer.status} {answer.body}")


def give(client, verb, *states):
    """The command is accepted, and the machine comes to a state of these modes."""
    answer = client.command(verb, BODIES[verb][0])
    expect(answer.status == 200, f"{verb}: {answer.status} {answer.body}")
    if states:
        client.await_state(lambda s: s["mode"] in states and all(axis["at_rest"] or s["mode"] != "Idle" for axis in s["axes"].values()))


def check_accepted(client):
    for verb in ("take", "give", "override", "tool", "offset", "jog"):
        give(client, verb)
    give(client, "home", "Idle")
    client.await_state(lambda s: all(axis["homed"] for axis in s["axes"].values()) and s["mode"] == "Idle")
    give(client, "touch")
    expect("has no probe" in refused(client.command("probe", BODIES["probe"][0]), 422, "not-measurable")["detail"], "another reason")
    refused(client.command("keep", BODIES["keep"][0]), 409, "no-measurement")
    refused(client.get("/api/heights"), 404, "no-measurement")
    give(client, "mdi", "Running")
    client.await_state(lambda s: s["mode"] == "Idle")
    long = "G21 G90\n" + "G1 X100 F600\nG1 X10\n" * 20 + "M2\n"
    expect(client.request("POST", "/api/program?name=long", long).status == 200, "not loaded")
    give(client, "run", "Running")
    client.await_state(lambda s: s["axes"]["X"]["velocity"] != 0)
    give(client, "hold", "Holding")
    give(client, "resume", "Running")
    give(client, "stop", "Idle")
    give(client, "estop", "Fault")
    give(client, "reset", "Idle")


def check_files(client, reports):
    (reports / "job.html").write_text("<p>done")
    names = [file["name"] for file in client.get("/api/reports").json()["files"]]
    expect("job.html" in names, names)
    page = client.get("/api/reports/job.html")
    expect(page.body == b"<p>done" and page.headers["content-security-policy"].startswith("sandbox"), page.headers)
    incident = next((name for name in names if name != "job.html"), None)
    expect(incident is None or client.get(f"/api/reports/{incident}").status == 200, incident)
    refused(client.get("/api/reports/none.html"), 404, "no-such-file")


def check_program(client):
    refused(client.command("run"), 409, "no-program")
    refused(client.get("/api/program"), 404, "no-program")
    refused(client.get("/api/program/path"), 404, "no-program")
    refused(client.request("POST", "/api/program?name=" + "n" * 201, PROGRAM), 400, "bad-value")
    refused(client.request("POST", "/api/program", "G1 X9999 F1\n"), 422, "bad-program")
    refused(client.request("POST", "/api/program", b"\x89PNG\r\n\x1a\n"), 415, "not-text")
    refused(client.request("POST", "/api/program", b"(x)\n" * 9_000_000), 413, "too-long")
    for kind in ("text/plain", "application/octet-stream"):
        expect(client.request("POST", "/api/program", PROGRAM, headers={"Content-Type": kind}).status == 200, kind)
    expect(client.get("/api/program").body.decode() == PROGRAM, "another text")
    expect(client.get("/api/program/path?points=2").status == 200, "no path")
    for wrong in ("1", "x", "1000001", "-2", "2.5", ""):
        refused(client.get(f"/api/program/path?points={wrong}"), 400, "bad-value")


def check_access(client, view, contract):
    for method, path in contract.operations():
        if (method, path) != ("POST", "/api/session"):
            refused(client.request(method, re.sub(r"\{\w+\}", "hold", path), token=""), 401, "no-session")
    for path in ("/api/commands/stop", "/api/program"):
        refused(client.request("POST", path, token=view), 403, "view-only")
    json_type = {"Content-Type": "application/json"}
    for path in ("/api/session", "/api/commands/hold"):
        refused(client.request("POST", path, "{", headers=json_type), 400, "bad-json")
        refused(client.request("POST", path, " " * 20_000, headers=json_type), 413, "too-long")
        refused(client.request("POST", path, "{}", headers={"Content-Type": "text/plain"}), 415, "not-json")
    expect(client.request("DELETE", "/api/session").status == 204, "not removed")
    for path in ("/api/session", "/api/machine", "/api/state", "/api/mdi"):
        expect(client.get(path, token=view).status == 200, path)
    expect(client.request("POST", "/api/session", {"token": view}, token="").status == 200, "no session")


def check_wrong_tokens(client):
    for _ in range(10):
        refused(client.request("POST", "/api/session", {"token": "wrong"}, token=""), 401, "wrong-token")
    refused(client.request("POST", "/api/session", {"token": client.token}, token=""), 429, "too-many-tokens")


def check_events(client, contract):
    events = Events(client)
    expect(events.status == 200 and "stream" in events.next()[1], "no stream")
    expect(events.next()[0] == "state", "a stream begins with the state")
    errors = contract.errors({"$ref": "#/components/schemas/State"}, events.state)
    expect(not errors, errors)
    others = [Events(client) for _ in range(199)]
    refused(client.get("/api/events"), 503, "too-many-viewers")
    for one in [events, *others]:
        one.close()
    contract.seen.add(("GET", "/api/events", 200))
    client.await_state(lambda s: s["viewers"] == 0)


def check_all_seen(contract):
    declared = {(*key, int(status)) for key, operation in contract.operations().items() for status in operation["responses"]}
    missing = declared - contract.seen - NOT_ASKED
    expect(not missing, f"in openapi.yaml and never answered: {sorted(missing)}")


def main():
    with served() as (machine, client):
        contract = client.contract
        check_routes(machine.root, contract)
        check_methods(client, contract)
        check_verbs(client, contract)
        check_program(client)
        check_accepted(client)
        check_files(client, machine.reports)
        check_events(client, contract)
        check_access(client, machine.tokens["view"], contract)
        machine.lockstep("down")
        client.await_state(lambda s: s["mode"] == "Unreachable")
        refused(client.command("home"), 503, "unreachable")
        check_wrong_tokens(client)
        check_all_seen(contract)


if __name__ == "__main__":
    main()
