"""bCNC at the pseudo-terminal, driven over its own pendant: homes, runs the program, holds, resumes and turns the feed.

To be run by hand, where Debian's bcnc, python3-numpy and xvfb are installed; docs/grbl.md has the command.
Usage: bcnc_sender.py TERMINAL PROGRAM FOLDER
"""
import json
import os
import shutil
import subprocess
import sys
import time
import urllib.error
import urllib.parse
import urllib.request

PORT = 8081
terminal, program, folder = sys.argv[1:4]
shutil.copy(program, f"{folder}/job.ngc")
with open(f"{folder}/.bCNC", "w") as settings:
    settings.write(f"[Connection]\nport = {terminal}\nbaud = 115200\ncontroller = GRBL1\nopenserial = 1\n"
                   f"pendant = 1\npendantport = {PORT}\n")


def ask(page, **arguments):
    query = "?" + urllib.parse.urlencode(arguments) if arguments else ""
    with urllib.request.urlopen(f"http://127.0.0.1:{PORT}/{page}{query}", timeout=10) as answer:
        return answer.read()


def state():
    try:
        return json.loads(ask("state"))
    except (urllib.error.URLError, ConnectionError):
        return {"state": "no answer"}


def await_state(name, seconds=120):
    end = time.monotonic() + seconds
    while not (newest := state())["state"].startswith(name):
        assert time.monotonic() < end, f"{newest} instead of {name}"
        time.sleep(0.2)
    print(f"{name}: X {newest['mx']} Y {newest['my']} Z {newest['mz']}, feed {newest['OvFeed']} %", flush=True)


screen = subprocess.Popen(["Xvfb", ":7", "-nolisten", "tcp"], stderr=subprocess.DEVNULL)
bcnc = subprocess.Popen(["/usr/bin/bCNC", f"{folder}/job.ngc"],
                        env=os.environ | {"DISPLAY": ":7", "HOME": folder, "BROWSER": "true"})
try:
    time.sleep(5)
    await_state("Alarm", 60)
    ask("send", cmd="HOME")
    await_state("Home")
    await_state("Idle")
    ask("send", cmd="RUN")
    await_state("Run")
    time.sleep(5)
    ask("send", cmd="SENDHEX 91")
    time.sleep(5)
    ask("send", cmd="FEEDHOLD")
    await_state("Hold:0")
    time.sleep(1)
    ask("send", cmd="RESUME")
    await_state("Run")
    ask("send", cmd="SENDHEX 90")
    await_state("Idle", 300)
    end = state()
    place = [float(end[axis]) for axis in ("mx", "my", "mz")]
    assert place == [20, 60, 40], end
finally:
    bcnc.terminate()
    screen.terminate()
