"""The machine under test, used only through the lockstep command."""
import json
import os
import random
import subprocess

AXES = ("X", "Y", "Z")
TRAVEL_MM = 60
LCM_URL = "udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4194304"
NEVER_ENDED = -1
CALL_PATIENCE_S = 90  # not a measurement: a command that hangs must not hang the test


def machine_text(name):
    """Three equal axes that home within seconds. The processes may stall for 200 ms, as on a busy host."""
    axis = """axis {{ name: "{name}" steps_per_mm: 80 start_velocity_mm_s: 20 max_velocity_mm_s: 120
  max_accel_mm_s2: 1500 max_decel_mm_s2: 1200 position_min_mm: 0 position_max_mm: {travel}
  homing {{ toward_min: true search_velocity_mm_s: 20 latch_velocity_mm_s: 10 pulloff_mm: 1 switch_position_mm: -1
    park_mm: 2 }}
  plant {{ start_position_mm: 4 travel_margin_mm: 2 max_torque_accel_mm_s2: 2250 max_jump_mm_s: 30 }} }}
"""
    return (f'name: "{name}"\n'
            "timing { slot_us: 20000 stall_slots: 10 late_check_slots: 5 freshness_slots: 11 send_ahead_slots: 34 frame_slots: 5 }\n"
            f'network {{ interface: "eth0" domain: 7 lcm_url: "{LCM_URL}" }}\n'
            + "".join(axis.format(name=axis_name, travel=TRAVEL_MM) for axis_name in AXES))


def random_job(rng, lines):
    """G-code within travel, about two lines a second: long moves and short, jerky and smooth, with rests."""
    place = lambda: round(rng.uniform(1, TRAVEL_MM - 1), 3)
    text = ["G21 G90"]
    for _ in range(lines):
        kind = rng.random()
        if kind < 0.1:
            text.append(f"G4 P{rng.choice((0.05, 0.2))}")
        elif kind < 0.4:
            text.append("G0 " + " ".join(f"{axis}{place()}" for axis in rng.sample(AXES, rng.randint(1, 3))))
        elif kind < 0.8:
            text.append(f"G1 X{place()} Y{place()} Z{place()} F{rng.randint(600, 6000)}")
        else:
            text += [f"G1 X{20 + 0.5 * i:.3f} Y{30 + rng.uniform(-0.2, 0.2):.3f} F3000" for i in range(12)]
    return "\n".join(text) + "\n"


class Machine:
    def __init__(self, lockstep, folder, seed):
        self.lockstep = lockstep
        self.folder = folder
        self.name = "chaos"
        self.rng = random.Random(f"jobs of {seed}")
        self.jobs = 0
        (folder / "machine.textproto").write_text(machine_text(self.name))
        self.environment = os.environ | {"LOCKSTEP_STATE": str(folder / "state"),
                                         "LOCKSTEP_MACHINE": str(folder / "machine.textproto")}

    def begin(self, *words):
        """A command that runs in parallel to the test."""
        return subprocess.Popen([self.lockstep, *words, "--json"], env=self.environment, text=True,
                                stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    @staticmethod
    def end(command):
        """The result of a command: exit code, report (empty if there is none), text output."""
        try:
            out, err = command.communicate(timeout=CALL_PATIENCE_S)
        except subprocess.TimeoutExpired:
            command.kill()
            return NEVER_ENDED, {}, f"it has not ended after {CALL_PATIENCE_S} s"
        return command.returncode, json.loads(out) if out.strip() else {}, err.strip()

    def call(self, *words):
        return self.end(self.begin(*words))

    def make_whole(self, received, whole):
        """Merges the log of lcm-logger and the processes' own logs. lcm-logger drops messages while it stalls,
        but it has messages that a killed process had not written yet."""
        record = self.folder / "state" / self.name / "record"
        subprocess.run([self.lockstep, "log", "merge", str(whole), str(received), str(record)], env=self.environment,
                       capture_output=True)  # the evaluation handles messages that no log has

    def verify(self, log):
        """The output of lockstep verify, and whether no step on record differs: of a killed axis the last may be missing."""
        ran = subprocess.run([self.lockstep, "verify", str(log)], env=self.environment, capture_output=True, text=True)
        return (ran.stdout + ran.stderr).strip(), ran.stdout.startswith(("exact:", "unknown:"))

    def status(self):
        return self.call("status")[1]

    def begin_job(self, lines=60):
        self.jobs += 1
        path = self.folder / f"job-{self.jobs}.gcode"
        path.write_text(random_job(self.rng, lines))
        return self.begin("run", str(path))

    def processes(self):
        """The running processes, by name: coordinator, axis-X ... with their ids."""
        lines = (self.folder / "state" / self.name / "processes").read_text().split("\n")
        records = [line.split() for line in lines if line]
        return {name: int(pid) for name, pid, _ in records if int(pid) > 0}

    def log(self, process):
        path = self.folder / "state" / self.name / f"{process}.log"
        return path.read_text(errors="replace") if path.exists() else ""
