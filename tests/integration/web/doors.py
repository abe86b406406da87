#!/usr/bin/env python3
"""A stop comes through while a client keeps hundreds of connections half open and another guesses tokens. Requests that
can be read in more than one way reach nothing.

Usage: doors.py ROOT PROGRAMS
"""
import http.client
import json
import socket
import sys
import time

sys.dont_write_bytecode = True
from client import expect, refused  # noqa: E402
from machine import served  # noqa: E402
from viewers import begin_motion  # noqa: E402

HALF_OPEN = 385
MOST_STOP_S = 5  # on a busy host


def half_open(client, number):
    """One of three: no byte, a part of a head, a part of a body."""
    begin = "POST /api/commands/run HTTP/1.1\r\nHost: localhost\r\n"
    texts = ("", begin, begin + "Content-Length: 100\r\n\r\n{")
    made = socket.create_connection(("127.0.0.1", client.port), timeout=30)
    made.sendall(texts[number % len(texts)].encode())
    return made


def check_flood(client):
    begin_motion(client)
    connections = [half_open(client, number) for number in range(HALF_OPEN)]
    begin = time.monotonic()
    expect(client.command("stop").status == 200, "no stop")
    expect(time.monotonic() - begin < MOST_STOP_S, f"the stop took {time.monotonic() - begin} s")
    client.await_state(lambda s: s["mode"] == "Idle" and s["job"]["outcome"] == "Stopped")
    return connections


def check_slow(connections):
    """Bytes that drip in do not keep a connection open."""
    end = time.monotonic() + 60
    while connections and time.monotonic() < end:
        time.sleep(1)
        for connection in list(connections):
            try:
                connection.sendall(b"x")
            except OSError:
                connections.remove(connection)
    expect(not connections, f"{len(connections)} slow connections are still open")


def check_tokens(client):
    """Ten wrong tokens lock their address, but not its stops and not its page that is signed in."""
    session = client.request("POST", "/api/session", {"token": client.token}, token="")
    cookie = {"Cookie": session.headers["set-cookie"].split(";")[0]}
    for number in range(10):
        refused(client.get("/api/state", token=f"guess{number}"), 401, "no-session")
    refused(client.get("/api/state", token="guess"), 429, "too-many-tokens")
    refused(client.get("/api/state"), 429, "too-many-tokens")
    refused(client.request("POST", "/api/session", {"token": client.token}, token=""), 429, "too-many-tokens")
    refused(client.command("home"), 429, "too-many-tokens")
    expect(client.get("/api/state", token="", headers=cookie).status == 200, "the page is locked out")
    expect(client.command("estop").status == 200, "an emergency stop is locked out")
    expect(client.command("reset", token="", headers=cookie).status == 200, "no reset")
    from_elsewhere = http.client.HTTPConnection("127.0.0.1", client.port, timeout=30, source_address=("127.0.0.2", 0))
    from_elsewhere.request("GET", "/api/state", headers={"Authorization": f"Bearer {client.token}"})
    expect(from_elsewhere.getresponse().status == 200, "another address is locked out")
    from_elsewhere.close()


def problem_of(client, head, body=""):
    """The refusal of a request with this head, which ends its connection."""
    with socket.create_connection(("127.0.0.1", client.port), timeout=30) as connection:
        connection.sendall(f"{head}\r\n\r\n{body}".encode())
        text = b""
        while more := connection.recv(4096):
            text += more
    status, _, document = text.partition(b"\r\n\r\n")
    return int(status.split()[1]), json.loads(document)


def check_heads(client):
    begin = "POST /api/commands/estop HTTP/1.1"
    token = f"Authorization: Bearer {client.token}"
    own = f"Host: 127.0.0.1:{client.port}"
    for head, status, code, place in (
            (f"{begin}\r\n{own}\r\nHost: evil.example\r\n{token}", 400, "bad-head", "host"),
            (f"{begin}\r\n{own}.evil.example\r\n{token}\r\nConnection: close", 403, "foreign-host", "host"),
            (f"{begin}\r\n{own}@evil.example\r\n{token}\r\nConnection: close", 403, "foreign-host", "host"),
            (f"{begin}\r\n{own}\r\n{token}\r\nContent-Length: 2\r\nContent-Length: 4", 400, "bad-head", "content-length"),
            (f"{begin}\r\n{own}\r\n{token}\r\nContent-Length: 2\r\nTransfer-Encoding: chunked", 400, "bad-head", "content-length"),
            (f"{begin}\r\n{own}\r\n{token}\r\nTransfer-Encoding:\r\n chunked", 400, "bad-head", "headers"),
            (f"POST http://evil.example/api/commands/estop HTTP/1.1\r\n{own}\r\n{token}", 400, "bad-head", "target"),
            (f"POST /api/commands/estop%00 HTTP/1.1\r\n{own}\r\n{token}", 400, "bad-head", "target")):
        seen, problem = problem_of(client, head, "{}")
        expect((seen, problem["code"], problem["place"]) == (status, code, place), f"{head}: {seen} {problem}")
        expect(problem["detail"] and problem["limit"] and problem["remedy"], problem)
    expect(client.state()["mode"] == "Idle", "a refused request was carried out")


def main():
    with served() as (_, client):
        check_heads(client)
        connections = check_flood(client)
        check_slow(connections)
        check_tokens(client)


if __name__ == "__main__":
    main()
