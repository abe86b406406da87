"""A machine with a server beside it, in its own network, for the time of a `with`."""
import contextlib
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

from client import Client
from contract import Contract


def own_network():
    """Runs this program again in its own network, where that is permitted."""
    if "OWN_NETWORK" not in os.environ and subprocess.run(["unshare", "--net", "true"], capture_output=True).returncode == 0:
        os.execvpe("unshare", ["unshare", "--net", "--", sys.executable, *sys.argv], {**os.environ, "OWN_NETWORK": "yes"})
    if "OWN_NETWORK" in os.environ:
        subprocess.run(["ip", "link", "set", "lo", "up"], check=True)


class Machine:
    """Up on entry, down on exit. `port` and `tokens` are those of the server."""

    def __init__(self, root, programs, example="two-axis", name=None, slot_us=20000):
        self.root = pathlib.Path(root)
        self.programs = pathlib.Path(programs)
        self.work = pathlib.Path(tempfile.mkdtemp())
        self.name = name or f"web{os.getpid()}"
        text = (self.root / "deploy/examples" / f"{example}.textproto").read_text()
        text = re.sub(r'^name: .*', f'name: "{self.name}"', text, count=1, flags=re.M)
        # With the default, slots that allow a busy host to stall a process for 200 ms.
        timing = f"slot_us: {slot_us}"
        text = re.sub(r"slot_us: \d+", timing, text) if "slot_us" in text else f"{text}\ntiming {{ {timing} }}\n"
        (self.work / "machine.textproto").write_text(text)
        self.reports = self.work / "reports"
        self.reports.mkdir()
        self.env = {**os.environ, "LOCKSTEP_STATE": str(self.work / "state"),
                    "LOCKSTEP_MACHINE": str(self.work / "machine.textproto")}
        self.server = None

    def lockstep(self, *words, check=True):
        return subprocess.run([self.programs / "lockstep", *words], env=self.env, check=check, capture_output=True, text=True)

    def serve(self, *words):
        """Starts the server, and reads what it prints."""
        self.server = subprocess.Popen([self.programs / "lockstep-web", "--port", "0", "--reports", self.reports, *words], env=self.env,
                                       stdout=subprocess.PIPE, text=True)
        self.server.stdout.readline()
        operate, view = (re.match(r"https?://[^:]+:(\d+)/#token=(\w+)$", self.server.stdout.readline().strip())
                         for _ in range(2))
        self.port = int(operate[1])
        self.tokens = {"operate": operate[2], "view": view[2]}

    def operator(self):
        """A client that may operate, once the machine is ready."""
        client = Client(self.port, self.tokens["operate"], Contract(self.root))
        client.await_state(lambda s: s["mode"] == "Idle" and s["offsets"])
        return client

    def end_server(self):
        self.server.send_signal(signal.SIGTERM)
        code = self.server.wait(20)
        self.server = None
        assert code == 0, f"lockstep-web ended with {code}"

    def __enter__(self):
        self.lockstep("up")
        return self

    def __exit__(self, *_):
        if self.server is not None:
            self.server.kill()
        self.lockstep("down", check=False)
        shutil.rmtree(self.work)


@contextlib.contextmanager
def served():
    """Yields (machine, client), from this program's arguments. The server and the machine end with the `with`."""
    own_network()
    with Machine(*sys.argv[1:]) as machine:
        machine.serve()
        yield machine, machine.operator()
        if machine.server is not None:
            machine.end_server()
