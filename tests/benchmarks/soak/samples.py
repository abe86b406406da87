"""Samples of the resources of the machine's processes."""
import csv
import dataclasses
import os
import pathlib
import time

SHARED = pathlib.Path("/dev/shm")


@dataclasses.dataclass
class Sample:
    seconds: float
    phase: str
    done: int  # number of clients or jobs of the phase until now
    process: str
    rss_anon_kb: int
    private_dirty_kb: int
    descriptors: int
    threads: int
    shm_files: int
    shm_kb: int
    files_kb: int


def kb_of(path, key):
    line = next(line for line in path.read_text().splitlines() if line.startswith(key + ":"))
    return int(line.split()[1])


class Samples:
    def __init__(self, machine):
        self.machine = machine
        self.processes = {}  # by name
        self.begun = time.monotonic()
        self.phase = ""
        self.failed_jobs = 0
        self.rows = []

    def begin(self, phase):
        self.phase = phase

    def take(self, done):
        shared = [path.stat().st_size for path in SHARED.iterdir()]
        files_kb = self.machine.files_kb()
        for name, pid in self.processes.items():
            of = pathlib.Path("/proc") / str(pid)
            if not of.exists():
                continue
            self.rows.append(Sample(
                seconds=round(time.monotonic() - self.begun, 1), phase=self.phase, done=done, process=name,
                rss_anon_kb=kb_of(of / "status", "RssAnon"),
                private_dirty_kb=kb_of(of / "smaps_rollup", "Private_Dirty"),
                descriptors=len(os.listdir(of / "fd")), threads=len(os.listdir(of / "task")),
                shm_files=len(shared), shm_kb=sum(shared) // 1024, files_kb=files_kb))

    def of(self, process, phase):
        return [row for row in self.rows if row.process == process and row.phase == phase]

    def replaced_processes(self):
        """A restarted process proves nothing about growth in one process, so it is an error."""
        now = self.machine.processes()
        return [f"{name} ended meanwhile" for name, pid in self.processes.items() if now.get(name) != pid]

    def write_csv(self, path):
        with path.open("w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow([field.name for field in dataclasses.fields(Sample)])
            writer.writerows(dataclasses.astuple(row) for row in self.rows)
