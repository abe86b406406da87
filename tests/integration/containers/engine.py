"""Podman with its own storage, networks and configuration, and its service for docker-compose."""
import contextlib
import os
import pathlib
import shutil
import subprocess
import time

CONFIGURATION = """
[containers]
default_ulimits = ["nofile=1024:1024", "nproc=1000:1000"]
[network]
network_backend = "netavark"
network_config_dir = "{work}/networks"
[engine]
helper_binaries_dir = ["/usr/lib/podman", "/usr/libexec/podman"]
runtime = "runc"
cgroup_manager = "cgroupfs"
events_logger = "file"
[engine.runtimes]
runc = ["{runc}"]
"""
STORE = "{{.Store.GraphDriverName}} {{.Store.GraphRoot}} {{.Store.RunRoot}}"


# However its processes end, no process and no mount is left behind.
NAMESPACES = ["setpriv", "--pdeathsig", "KILL", "unshare", "--mount", "--pid", "--fork", "--kill-child", "--mount-proc"]
NAMESPACES_WITH_NETWORK = [*NAMESPACES, "--net"]


class Podman:
    def __init__(self, work):
        work.mkdir(parents=True, exist_ok=True)
        configuration = work / "containers.conf"
        configuration.write_text(CONFIGURATION.format(work=work, runc=shutil.which("runc") or "/usr/sbin/runc"))
        self.environment = os.environ | {"CONTAINERS_CONF": str(configuration)}
        # Beside the storage, which is kept: the state of running containers ends with their namespaces.
        self.command = ["podman", "--root", str(work / "storage"), "--runroot", str(work / "run")]

    def run(self, *words, extra=None, **how):
        """`extra`: additional environment variables."""
        return subprocess.run([*self.command, *words], env=self.environment | (extra or {}), text=True, **how)

    def ask(self, *words):
        """Exit code, and its output."""
        ran = self.run(*words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        return ran.returncode, ran.stdout.strip()

    def as_the_hosts(self):
        """The environment of a program that calls podman itself: it uses this storage as the host's."""
        driver, images, running = self.ask("info", "--format", STORE)[1].split()
        file = pathlib.Path(running) / "storage.conf"
        file.write_text(f'[storage]\ndriver = "{driver}"\ngraphroot = "{images}"\nrunroot = "{running}"\n')
        return self.environment | {"CONTAINERS_STORAGE_CONF": str(file)}


def hide_the_host():
    """Podman keeps locks and namespaces in fixed places: here these are private to the namespaces."""
    subprocess.run(["mount", "--make-rprivate", "/"], check=True)
    for place in ("/run", "/dev/shm"):
        subprocess.run(["mount", "-t", "tmpfs", "tmpfs", place], check=True)


class Service:
    """A service that replaces the Docker engine for docker-compose, while it exists."""

    PATIENCE_S = 30

    def __init__(self, podman, work):
        self.podman = podman
        self.socket = pathlib.Path("/run/podman.sock")
        self.log = work / "podman.log"

    def __enter__(self):
        with open(self.log, "w", encoding="utf-8") as log:
            self.process = subprocess.Popen(
                [*self.podman.command, "system", "service", "-t", "0", f"unix://{self.socket}"],
                env=self.podman.environment, stdout=log, stderr=log)
        deadline = time.monotonic() + self.PATIENCE_S
        while not self.socket.exists():
            if self.process.poll() is not None or time.monotonic() > deadline:
                raise RuntimeError(f"podman's service does not start: {self.log.read_text()}")
            time.sleep(0.05)
        return self

    def __exit__(self, *_):
        self.podman.ask("rm", "--all", "--force", "--time", "0")
        self.podman.ask("network", "prune", "--force")
        self.podman.ask("volume", "prune", "--force")
        self.process.terminate()
        self.process.wait()
        leave_no_group()


def leave_no_group():
    """The kernel refuses to remove a control group that is not empty."""
    for control in ("", "*/"):
        for parent in pathlib.Path("/sys/fs/cgroup").glob(f"{control}libpod_parent"):
            for group in sorted([parent, *parent.glob("**/")], reverse=True):
                with contextlib.suppress(OSError):
                    group.rmdir()
