"""The machine as compose starts it, and as a user operates it."""
import json
import os
import re
import subprocess
import time

import image

PARTS = ("coordinator", "axis-x", "axis-y", "axis-z")
# The log of the logger, completed by the parts' own logs: lcm-logger drops messages while it stalls itself.
VERIFY_ALL = "lockstep log merge --force whole.lcm record.lcm.0 /records/*/*/record; lockstep verify whole.lcm"
PATIENCE_S = 90  # not a measurement: a hanging command must not hang the test
TRIES = 6        # of actions that fail if the host stalls for longer than the machine allows


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
        """`docker compose`: exit code, and its output."""
        command = ["docker-compose", *(word for file in self.files for word in ("-f", file)), *words]
        ran = subprocess.run(command, cwd=self.folder, env=self.environment, text=True, stdin=subprocess.DEVNULL,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=PATIENCE_S)
        return ran.returncode, ran.stdout.strip()

    def use(self, files, machine):
        self.files = files
        self.environment["MACHINE_FILE"] = str(machine)

    def up(self):
        code, output = self.compose("up", "--detach", "--no-build")
        return self.expect(code == 0, f"docker compose up: exit code {code}: {output}")

    def down(self):
        self.compose("down", "--volumes", "--timeout", "0")

    def client(self, *words):
        return self.compose("run", "-T", "--rm", "client", *words)

    def client_by_podman(self, *words):
        """The same without docker-compose, which mistakes podman's network with addresses for a changed one."""
        volumes = [f"mill_{part}:/records/{part}:ro" for part in PARTS]
        volumes += ["mill_log:/var/log/lockstep", f"{self.environment['MACHINE_FILE']}:/etc/lockstep/machine.textproto:ro"]
        return self.podman.ask("run", "--rm", "--network", "mill_machine", "--workdir",
                               "/var/log/lockstep", *(word for volume in volumes for word in ("--volume", volume)),
                               image.NAME, *words)

    # ---- Commands and reports, from within the coordinator's container: faster than in another one

    def container(self, part):
        return f"mill_{part}_1"

    def inside(self, part, *words):
        return self.podman.ask("exec", self.container(part), *words)

    def begin(self, *words):
        return subprocess.Popen([*self.podman.command, "exec", self.container("coordinator"), "lockstep", *words],
                                env=self.podman.environment, text=True, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT)

    def status(self):
        code, output = self.podman.ask("exec", self.container("coordinator"), "lockstep", "status", "--json")
        begin = output.find("{")
        return json.loads(output[begin:output.rfind("}") + 1]) if code == 0 and begin >= 0 else {}

    def wait_for(self, what, holds):
        """The first status that satisfies the condition."""
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
        """Homes the machine from any state, as a user does: the machine's state determines the commands."""
        for _ in range(TRIES):
            status = self.wait_for("all axes are there and nothing moves", is_settled)
            if not status or (status["phase"] == "Idle" and all(axis.get("homed") for axis in status["axes"])):
                return bool(status)
            word = {"Idle": "home", "Fault": "reset"}.get(status["phase"], "stop")
            _, output = self.inside("coordinator", "lockstep", word)
        return self.expect(False, f"the machine cannot be homed: {output}")

    def move(self, *words, by=None):
        """A move, repeated if a stall of the host interrupted it."""
        for _ in range(TRIES):
            if not self.home():
                return False
            code, output = by(*words) if by else self.inside("coordinator", "lockstep", *words)
            if code == 0:
                return True
        return self.expect(False, f"lockstep {' '.join(words)}: exit code {code}: {output}")

    def verify(self, script=VERIFY_ALL, by=None, killed=False):
        """Verifies the record once it is complete. Returns the count of its steps. The last ones of an axis that was
        killed may be missing."""
        client = by or self.client
        deadline = time.monotonic() + 20
        exact = r"^exact: (\d[\d ]*) steps"
        as_planned = r"^(?:exact|unknown): (?:.*: )?(\d[\d ]*) steps"
        while True:
            code, output = client("sh", "-c", script)
            found = re.search(as_planned if killed else exact, output, re.MULTILINE)
            if found or time.monotonic() > deadline:
                break
            time.sleep(0.5)
        self.expect(found, f"lockstep verify: exit code {code}: {output}")
        return int(found.group(1).replace(" ", "")) if found else 0

    def inspect(self, part):
        return json.loads(self.podman.ask("inspect", self.container(part))[1])[0]


def is_settled(status):
    return (status["phase"] in ("Idle", "Fault", "Holding", "Paused")
            and all(axis.get("present") for axis in status["axes"]))
