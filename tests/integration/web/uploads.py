#!/usr/bin/env python3
"""Programs of megabytes are loaded, drawn and run. A text that is too long or no program gets a clear answer, also if
the client sends all of it. Reports of past jobs are listed and opened.

Usage: uploads.py ROOT PROGRAMS
"""
import socket
import sys
import zlib

sys.dont_write_bytecode = True
from client import expect, refused  # noqa: E402
from machine import served  # noqa: E402

MEGABYTE = 1 << 20


def picture(size):
    """The beginning of a PNG file, and bytes that look like its content."""
    noise = zlib.compress(bytes(range(256)) * 4000, 0)
    return (b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" + noise * (size // len(noise) + 1))[:size]


def check_refused(client):
    problem = refused(client.request("POST", "/api/program?name=big", b"(a comment)\n" * (100 * MEGABYTE // 12)), 413, "too-long")
    expect("lockstep run" in problem["remedy"], problem)
    refused(client.request("POST", "/api/program?name=a.png", picture(MEGABYTE)), 415, "not-text")
    refused(client.request("POST", "/api/program?name=a.png", picture(100 * MEGABYTE)), 413, "too-long")
    for kind in ("image/png", "multipart/form-data; boundary=x"):
        refused(client.request("POST", "/api/program", picture(100), headers={"Content-Type": kind}), 415, "not-text")
    refused(client.get("/api/program"), 404, "no-program")


def check_told_early(client):
    """A client that asks before it sends is refused at once."""
    with socket.create_connection(("127.0.0.1", client.port), timeout=60) as connection:
        connection.sendall(f"POST /api/program HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer {client.token}\r\n"
                           f"Content-Length: {100 * MEGABYTE}\r\nExpect: 100-continue\r\n\r\n".encode())
        line = connection.makefile("rb").readline()
        expect(b" 413 " in line, line)


def check_unfinished(client):
    """A client that goes away in the middle of an upload leaves nothing behind."""
    for _ in range(20):
        with socket.create_connection(("127.0.0.1", client.port), timeout=60) as connection:
            connection.sendall(f"POST /api/program HTTP/1.1\r\nHost: localhost\r\nAuthorization: Bearer {client.token}\r\n"
                               f"Content-Length: {MEGABYTE}\r\n\r\nG21".encode())
    refused(client.get("/api/program"), 404, "no-program")


def check_long_program(client):
    client.command("home")
    client.await_state(lambda s: s["mode"] == "Idle" and all(axis["homed"] for axis in s["axes"].values()))
    lines = [f"G1 X{20 + i % 7} Y{(i * i) % 11} F3000" for i in range(160_000)]
    text = "G21 G90\n" + "\n".join(lines) + "\nM2\n"
    expect(len(text) > 2 * MEGABYTE, "more than is read as a whole before it runs")
    loaded = client.request("POST", "/api/program?name=long.gcode", text)
    expect(loaded.status == 200 and loaded.json()["lines"] == 160_002, loaded.body)
    path = client.get("/api/program/path?points=10000")
    expect(len(path.body) <= 160_000 and int(path.headers["lockstep-all-points"]) > 100_000, path.headers)
    expect(client.get("/api/program").body.decode() == text, "another text")
    expect(client.command("run").status == 200, "not begun")
    client.await_state(lambda s: s["mode"] == "Running" and (s["job"]["line"] or 0) > 10)
    expect(client.command("stop").status == 200, "no stop")
    client.await_state(lambda s: s["mode"] == "Idle" and s["job"]["outcome"] == "Stopped")


def check_reports(machine, client):
    """The report of the job that was just run, from the machine's own record."""
    logs = machine.work / "job.lcm"
    records = {str(file.parent) for file in (machine.work / "state").rglob("*.lcm")}
    machine.lockstep("log", "merge", str(logs), *records)
    machine.lockstep("analyze", str(logs), "--html", str(machine.reports / "job.html"), check=False)
    files = client.get("/api/reports").json()["files"]
    expect([file["name"] for file in files if file["kind"] == "report"] == ["job.html"], files)
    page = client.get("/api/reports/job.html")
    expect(page.body == (machine.reports / "job.html").read_bytes() and b"<html" in page.body, "another page")
    expect("sandbox" in page.headers["content-security-policy"], page.headers)


def main():
    with served() as (machine, client):
        check_refused(client)
        check_told_early(client)
        check_unfinished(client)
        check_long_program(client)
        check_reports(machine, client)


if __name__ == "__main__":
    main()
