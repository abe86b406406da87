#!/usr/bin/python3
"""Changes the code in one place at a time and runs the tests: each change that no test notices is listed.

  tests/mutation/run_mutants.py [--folder build-mutants] [--seed 1] [--sample 400] [--runs 1000]
  tests/mutation/run_mutants.py --only 17,93     these mutants again

The README beside it says what the result means."""
import argparse
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path.insert(0, str(HERE))
from make_mutants import find, rewrite  # noqa: E402
from programs import steps, targets  # noqa: E402

FOLDERS = [f"core/{f}" for f in ("axis", "coordinator", "protocol", "motion", "clock", "step", "path", "gcode",
                                 "kinematics")]

MEMORY_LIMIT = 4 << 30  # bytes: a mutant may append to a vector without an end


def copy_sources(copy):
    listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    for name in listed.splitlines():
        source, into = ROOT / name, copy / name
        if not source.is_file() or any(name.startswith(f + "/") for f in FOLDERS):
            continue
        if not into.exists() or into.read_bytes() != source.read_bytes():
            into.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(source, into)


def build(copy, wanted):
    """Builds these targets. The lines that did not compile, as (file, line)."""
    flags = f"-include {HERE}/mutant.hpp -w -fpermissive -Wno-narrowing"
    subprocess.run(["cmake", "-S", copy, "-B", copy / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                    "-DCMAKE_UNITY_BUILD=ON", "-DLOCKSTEP_WERROR=OFF", "-DLOCKSTEP_SPY=OFF",
                    f"-DCMAKE_CXX_FLAGS={flags}", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG"],
                   check=True, stdout=subprocess.DEVNULL)
    done = subprocess.run(["cmake", "--build", copy / "build", "-j", str(os.cpu_count()), "--", "-k", "0", *wanted],
                          capture_output=True, text=True)
    if done.returncode == 0:
        return set()
    bad = set()
    for line in done.stdout.splitlines():
        place = rf"(?:{re.escape(str(copy))}/)?(?:\.\./)*(core/[^:]+):(\d+):\d*:? +"
        at = re.match(place + "(?:error|fatal error|  required from)", line)
        if at:
            bad.add((at[1], int(at[2])))
    if not bad:
        raise SystemExit("the copy does not build:\n" + done.stdout[-4000:])
    return bad


def make(copy, wanted):
    """Writes the copy and builds the targets, and leaves out changes that do not compile until the rest compiles."""
    copy_sources(copy)
    found = list(find(ROOT, FOLDERS))
    dropped = set()
    while True:
        mutants = rewrite(found, copy, dropped)
        bad = build(copy, wanted) - dropped
        if not bad:
            return mutants
        print(f"{len(bad)} lines have changes that do not compile: left out", flush=True)
        dropped |= bad


def run(copy, step, environment, limit):
    """Runs one step, with a limit of its processor time in seconds, which a busy host does not change, and of its
    memory. Returns None if it passed, otherwise how it failed."""
    def limited():
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit))
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_LIMIT, MEMORY_LIMIT))
    try:
        done = subprocess.run(["nice", "-n", "5", *step.command], cwd=copy, preexec_fn=limited, timeout=20 * limit,
                              env=os.environ | step.environment | environment,
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    except subprocess.TimeoutExpired:
        return "time"
    return None if done.returncode == 0 else "time" if done.returncode == -signal.SIGKILL else "failed"


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def file_name(step):
    return re.sub(r"[^\w.]", "_", step.name) + ".txt"


def measure(copy, wanted):
    """Runs each step without a change, to measure its time and the mutants that it reaches."""
    kept = copy / "reached"
    kept.mkdir(exist_ok=True)
    for step in wanted:
        reached = kept / file_name(step)
        if not reached.exists():
            begun = processor_seconds()
            if run(copy, step, {"LOCKSTEP_REACHED": str(reached)}, 900):
                raise SystemExit(f"{step.name} fails without any change")
            seconds = processor_seconds() - begun
            reached.write_text(f"{seconds}\n" + (reached.read_text() if reached.exists() else ""))
        seconds, *numbers = reached.read_text().split()
        step.seconds, step.reaches = float(seconds), set(map(int, numbers))


def kill(copy, n, wanted):
    """The step that detects mutant n, and how it failed."""
    for step in wanted:
        if n in step.reaches:
            how = run(copy, step, {"LOCKSTEP_MUTANT": str(n)}, int(5 * step.seconds) + 2)
            if how:
                return f"{step.name}: {how}"
    return None


def key(mutant):
    return f"{mutant['file']} | {mutant['was']} | {mutant['is'] or 'nothing'}"


def equivalents():
    """The changes without an effect, from lines `file | was | is | reason`."""
    lines = (HERE / "equivalents.txt").read_text().splitlines() if (HERE / "equivalents.txt").exists() else []
    return {" | ".join(line.split(" | ")[:-1]) for line in lines if line and not line.startswith("#")}


def report(mutants, results, wanted):
    known = equivalents()
    survivors = [n for n, how in results.items() if how is None]
    same = [n for n in survivors if key(mutants[n]) in known]
    for n in sorted(set(survivors) - set(same)):
        m = mutants[n]
        seen = "" if any(n in step.reaches for step in wanted) else " (no test reaches it)"
        print(f"survived {n}: {m['file']}:{m['line']}: {m['what']}{seen}: {key(m).split(' | ', 1)[1]}")
    print("\n| folder | mutants | killed | equivalent | survived |\n|---|---|---|---|---|")
    for folder in [*FOLDERS, ""]:
        here = [n for n in results if mutants[n]["file"].startswith(folder)]
        dead = sum(results[n] is not None for n in here)
        equal = sum(n in same for n in here)
        left = len(here) - dead - equal
        print(f"| {folder or 'all'} | {len(here)} | {dead} | {equal} | {left} |")
    judged = len(results) - len(same)
    print(f"\nkilled: {100 * (judged - (len(survivors) - len(same))) / max(1, judged):.1f} % of those not equivalent")


def main():
    options = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    options.add_argument("--folder", type=pathlib.Path, default=ROOT / "build-mutants")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--sample", type=int, default=400)
    options.add_argument("--runs", type=int, default=1000, help="of drawn machines, at most those of steps.txt")
    options.add_argument("--quick", type=float, default=1e9, help="leaves out the programs that take more seconds")
    options.add_argument("--without", default="", help="programs that are neither built nor run, with commas")
    options.add_argument("--again", action="store_true", help="builds the tests again; continues with the copy's mutants")
    options.add_argument("--only", help="numbers of mutants, with commas")
    options.add_argument("--survivors", action="store_true", help="only the mutants that survived the last time")
    options.add_argument("--built", action="store_true", help="continue with the existing copy and its results")
    given = options.parse_args()
    copy = given.folder.resolve()
    copy.mkdir(exist_ok=True)
    without = given.without.split(",")
    if given.again:
        copy_sources(copy)
        if build(copy, targets(without)):
            raise SystemExit("the copy does not build with these tests")
    if given.built or given.again:
        mutants = json.loads((copy / "mutants.json").read_text())
    else:
        mutants = make(copy, targets(without))
    if not given.built:
        (copy / "results.json").unlink(missing_ok=True)
        shutil.rmtree(copy / "reached", ignore_errors=True)
    usable = [n for n, mutant in enumerate(mutants) if mutant["used"]]
    print(f"{len(usable)} mutants")
    kept = copy / "results.json"
    results = {int(n): how for n, how in json.loads(kept.read_text()).items()} if kept.exists() else {}
    chosen = sorted(random.Random(given.seed).sample(usable, min(given.sample, len(usable))))
    if given.only:
        chosen = [int(n) for n in given.only.split(",")]
    wanted = steps(copy, given.runs, without)
    measure(copy, wanted)
    wanted = sorted((step for step in wanted if step.seconds <= given.quick), key=lambda step: step.seconds)
    for n in random.Random(given.seed).sample(chosen, len(chosen)):  # random order: the results so far are a sample too
        if n in results and not (results[n] is None and (given.survivors or given.only)):
            continue
        results[n] = kill(copy, n, wanted)
        kept.write_text(json.dumps(results))
        print(f"{n}: {results[n] or 'survived'}", flush=True)
    report(mutants, {n: results[n] for n in chosen if n in results}, wanted)


if __name__ == "__main__":
    main()
