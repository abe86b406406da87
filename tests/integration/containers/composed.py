"""The machine as compose starts it, and as a user finds it."""
import json
import os
import re
import subprocess
import time

import image

PARTS = ("coordinator", "axis-x", "axis-y", "axis-z")
# What the logger heard, made whole by the parts' own logs: lcm-logger drops what comes while it stands still itself.
VERIFY_ALL = "lockstep log merge --force whole.lcm record.lcm.0 /records/*/*/record; lockstep verify whole.lcm"
PATIENCE_S = 90  # nothing is measured by it: what hangs must not hang the test
TRIES = 6        # of what a host that stalls for longer than the machine bears may spoil


class Composed:
    def __init__(self, podman, service, root, work, programs):
        self.podman, self.programs = podman, programs
        self.files = ["compose.yaml"]
        self.folder, self.work = root / "deploy", work
        self.environment = os.environ | {"DOCKER_HOST": f"unix://{service.socket}", "COMPOSE_PROJECT_NAME": "mill"}
        self.failures = []

    def expect(self, holds, failure):
        if not holds:
            self.failures.append(failure)
        return holds

    # ---- What a user types

    def compose(self, *words):
        """`docker compose`: exit code, and all that it said."""
        command = ["docker-compose", *(word for file in self.files for word in ("-f", file)), *words]
        ran = subprocess.run(command, cwd=self.folder, env=self.environment, text=True, stdin=subprocess.DEVNULL,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=PATIENCE_S)
        return ran.returncode, ran.stdout.strip()

    def use(self, files, machine):
        self.files = files
        self.environment["MACHINE_FILE"] = str(machine)

    def up(self):
        code, said = self.compose("up", "--detach", "--no-build")
        return self.expect(code == 0, f"docker compose up: exit code {code}: {said}")

    def down(self):
        self.compose("down", "--volumes", "--timeout", "0")

    def client(self, *words):
        return self.compose("run", "-T", "--rm", "client", *words)

    def client_by_podman(self, *words):
        """The same without docker-compose, which takes podman's network with addresses for one that has changed."""
        volumes = [f"mill_{part}:/records/{part}:ro" for part in PARTS]
        volumes += ["mill_log:/var/log/lockstep", f"{self.environment['MACHINE_FILE']}:/etc/lockstep/machine.textproto:ro"]
        return self.podman.ask("run", "--rm", "--network", "mill_machine", "--workdir",
                               "/var/log/lockstep", *(word for volume in volumes for word in ("--volume", volume)),
                               image.NAME, *words)

    # ---- What it is told and says, from within the coordinator's container: sooner than by one more

    def container(self, part):
        return f"mill_{part}_1"

    def inside(self, part, *words):
        return self.podman.ask("exec", self.container(part), *words)

    def begin(self, *words):
        return subprocess.Popen([*self.podman.command, "exec", self.container("coordinator"), "lockstep", *words],
                                env=self.podman.environment, text=True, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def status(self):
        code, said = self.podman.ask("exec", self.container("coordinator"), "lockstep", "status", "--json")
        begin = said.find("{")
        return json.loads(said[begin:said.rfind("}") + 1]) if code == 0 and begin >= 0 else {}

    def wait_for(self, what, holds):
        """The first status that is so."""
        deadline = time.monotonic() + PATIENCE_S
        status = {}
        while time.monotonic() < deadline:
            status = self.status()
            if status and holds(status):
                return status
            time.sleep(0.1)
        self.expect(False, f"{what}: not within {PATIENCE_S} s: {json.dumps(status)[:600]}")
        return {}

    def home(self):
        """From whatever state to Idle and homed, as a user does: what the machine says decides what is done."""
        for _ in range(TRIES):
            status = self.wait_for("all axes are there and nothing moves", is_settled)
            if not status or (status["phase"] == "Idle" and all(axis.get("homed") for axis in status["axes"])):
                return bool(status)
            word = {"Idle": "home", "Fault": "reset"}.get(status["phase"], "stop")
            _, said = self.inside("coordinator", "lockstep", word)
        return self.expect(False, f"the machine cannot be homed: {said}")

    def move(self, *words, by=None):
        """A move, again where the host spoiled it."""
        for _ in range(TRIES):
            if not self.home():
                return False
            code, said = by(*words) if by else self.inside("coordinator", "lockstep", *words)
            if code == 0:
                return True
        return self.expect(False, f"lockstep {' '.join(words)}: exit code {code}: {said}")

    def verify(self, script=VERIFY_ALL, by=None):
        """What lockstep says of the record, as soon as it is whole. The count of its steps."""
        client = by or self.client
        deadline = time.monotonic() + 20
        while True:
            code, said = client("sh", "-c", script)
            if code == 0 or time.monotonic() > deadline:
                break
            time.sleep(0.5)
        found = re.search(r"^exact: (\d+) steps", said, re.MULTILINE)
        self.expect(code == 0 and found, f"lockstep verify: exit code {code}: {said}")
        return int(found.group(1)) if found else 0

    def inspect(self, part):
        return json.loads(self.podman.ask("inspect", self.container(part))[1])[0]


def is_settled(status):
    return (status["phase"] in ("Idle", "Fault", "Holding", "Paused")
            and all(axis.get("present") for axis in status["axes"]))
