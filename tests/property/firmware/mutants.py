#!/usr/bin/env python3
"""Changes the firmware's device one place at a time. The comparison with the simulated device must fail for each mutant.

Usage: mutants.py ROOT BUILD    Prints each mutant that the test does not detect; exits 1 if there is one.

A mutant's library has the name of the one that the test program is linked with, so LD_PRELOAD replaces that.
"""
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

DEVICE = pathlib.Path("sim_fpga/firmware/device")
TIMEOUT_S = 120  # on a busy machine

# (file, what is there once, what the mutant has instead)
MUTANTS = [
    ("add_ticks.cpp", "axis->phase < axis->velocity", "axis->phase <= axis->velocity"),
    ("engine.cpp", "carries ^ backward", "carries"),
    ("engine.cpp", "axis_ = before;\n        return execute_across_rest(ticks);", "return {carries, 0};"),
    ("engine.hpp", "            execute(n);\n", ""),
    ("wide.hpp", "(low < one.low ? 1 : 0)", "0"),
    ("segment_queue.cpp", "header.pieces() >= loaded()", "header.pieces() > loaded()"),
    ("device.cpp", "next.is_frame(number) && may_run(number)", "next.is_frame(number)"),
    ("device.cpp", "words_.load(kVeto) <= frame", "words_.load(kVeto) < frame"),
    ("device.cpp", "frame.from(engine_.place().count) == engine_.place()", "true"),
    ("device.cpp", "direction < 0 ? setup().limit_min : setup().limit_max", "setup().limit_max"),
    ("device.cpp", "from.phase == kForwardPhase || from.phase == kBackwardPhase", "from.phase == kForwardPhase"),
    ("device.cpp", "        into_limit_ = true;\n", ""),
    ("device.cpp", "channels_.begin_tail(moment());", ""),
    ("output_queue.cpp", "list.changes[list.size - 1].at <= change.at", "list.changes[list.size - 1].at < change.at"),
    ("outputs.cpp", "tick + compare_ticks_", "tick + compare_ticks_ + 1"),
    ("host_watch.hpp", "heard_ = now;\n        is_silent_ = false;\n    }\n    /// The", "is_silent_ = false;\n    }\n    /// The"),
    ("inputs.cpp", "if ((pending_ & bit) == 0) { since_[n] = now; }", "since_[n] = now;"),
    ("capture.hpp", "sums_ += sum_;", "sums_ += word;"),
]


def detected(root, build, mutant):
    file, there, instead = mutant
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        shutil.copytree(root / DEVICE, work / DEVICE)
        source = (work / DEVICE / file).read_text()
        if source.count(there) != 1:
            sys.exit(f"{file} has `{there}` {source.count(there)} times, not once")
        (work / DEVICE / file).write_text(source.replace(there, instead))
        whole = work / "whole.cpp"
        whole.write_text("".join(f'#include "{path}"\n' for path in sorted((work / DEVICE).glob("*.cpp"))))
        library = work / "liblockstep_firmware.so"
        subprocess.run(["c++", "-std=c++20", "-O0", "-w", "-shared", "-fPIC", f"-I{work}", f"-I{root}", f"-I{build}",
                        whole, "-o", library], check=True)
        program = build / "bin" / "property_firmware"
        run = subprocess.run([program, "--gtest_fail_fast"],
                             env={**os.environ, "LD_PRELOAD": str(library)}, capture_output=True, timeout=TIMEOUT_S,
                             check=False)
        return run.returncode == 1  # a test failed


def main():
    root, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:])
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        found = list(pool.map(lambda mutant: detected(root, build, mutant), MUTANTS))
    for (file, there, instead), was_detected in zip(MUTANTS, found):
        if not was_detected:
            print(f"{file}: no test notices `{instead}` in place of `{there}`")
    print(f"{sum(found)} of {len(found)} mutants are detected")
    return 0 if all(found) else 1


if __name__ == "__main__":
    sys.exit(main())
