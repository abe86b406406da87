"""The machine under test, controlled by the lockstep command alone."""
import json
import os
import pathlib
import subprocess
import time

NAME = "soak"
PATIENCE_S = 180
AXES = ("X", "Y", "Z")


def machine_text(options, keys):
    axis = ('axis {{ name: "{name}" steps_per_mm: 80 start_velocity_mm_s: 20 max_velocity_mm_s: 120 '
            "max_accel_mm_s2: 1500 position_min_mm: 0 position_max_mm: 100 homing {{ search_velocity_mm_s: 20 "
            "latch_velocity_mm_s: 10 pulloff_mm: 1 park_mm: 2 }} plant {{ start_position_mm: 4 }} }}\n")
    security = f'security {{ directory: "{keys}" }}\n' if options.security else ""
    real_time = "real_time { priority: 1 }\n" if options.real_time else ""
    return (f'name: "{NAME}"\n{security}{real_time}'
            f"timing {{ slot_us: {round(options.slot_ms * 1000)} stall_slots: 10 late_check_slots: 5 "
            "freshness_slots: 11 send_ahead_slots: 34 frame_slots: 5 }\n"
            'network { interface: "lo" domain: 9 }\n' + "".join(axis.format(name=name) for name in AXES))


class Machine:
    def __init__(self, build, folder, options):
        self.lockstep = build / "bin" / "lockstep"
        self.folder = folder
        self.state = folder / "state" / NAME
        self.secured = options.security
        self.keys = folder / "keys"
        self.file = folder / "machine.textproto"
        self.file.write_text(machine_text(options, self.keys))
        self.environment = os.environ | {"LOCKSTEP_STATE": str(folder / "state"), "LOCKSTEP_MACHINE": str(self.file)}
        self.watch = None
        self.last_words = ""

    def begin(self, *words):
        return subprocess.Popen([self.lockstep, *words], env=self.environment, stdin=subprocess.DEVNULL,
                                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def call(self, *words):
        """True: the job was completed."""
        ran = subprocess.run([self.lockstep, *words], env=self.environment, capture_output=True, text=True,
                             timeout=PATIENCE_S, check=False)
        self.last_words = (ran.stdout + ran.stderr).strip()
        return ran.returncode == 0

    def must(self, *words):
        if not self.call(*words):
            raise RuntimeError(f"lockstep {' '.join(words)}: {self.last_words}")

    def up(self):
        if self.secured:
            self.must("keys", "make", "--directory", str(self.keys))
        self.must("up", "--standby", "--fpga", "shm")
        self.must("home")
        self.watch = self.begin("watch", "--json")

    def down(self):
        if self.watch:
            self.watch.terminate()
            self.watch.wait()
        self.call("down")

    def processes(self):
        """The running processes by name."""
        lines = (self.state / "processes").read_text().splitlines()
        running = {name: int(pid) for name, pid, _ in map(str.split, lines) if int(pid) > 0}
        return running | ({"watch": self.watch.pid} if self.watch else {})

    def phase(self):
        return json.loads(self.last_words).get("phase") if self.call("status", "--json") else None

    def wait_until_idle(self):
        deadline = time.monotonic() + PATIENCE_S
        while (phase := self.phase()) != "Idle":
            if time.monotonic() > deadline:
                raise RuntimeError(f"the machine does not come to rest: {self.last_words}")
            if phase == "Fault":  # a busy host may stall a device
                self.recover()
            time.sleep(0.2)

    def short_job(self, number):
        """Moves back and forth: of every four jobs one moves all axes, one is a program, and two move a single axis."""
        place = 10 + number // 4 % 2
        if number % 4 == 0:
            return self.call("move", *(f"{axis}={place}" for axis in AXES))
        if number % 4 > 1:
            return self.call("move", "--own", f"X={place + number % 4}")
        job = self.folder / "job.gcode"
        job.write_text(f"G21 G90\nG1 X{place} Y{place} F3000\nG1 Z{place}\nG0 X{place + 1}\n")
        return self.call("run", str(job))

    def recover(self):
        """Prepares the machine again after a stalled host interrupted a job."""
        self.call("reset")
        self.call("home")
        self.wait_until_idle()

    def files_kb(self):
        """The files of its processes: logs, record, incidents."""
        return sum(path.stat().st_size for path in pathlib.Path(self.state).rglob("*") if path.is_file()) // 1024
