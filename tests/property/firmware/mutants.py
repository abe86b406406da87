#!/usr/bin/env python3
"""Changes the firmware's device and link one place at a time. The property tests must fail for each mutant.

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

FIRMWARE = pathlib.Path("sim_fpga/firmware")
TIMEOUT_S = 120  # on a busy machine

# The tests that concern a folder.
TESTS = {"device": "FirmwareDevice.*:FirmwareEngine.*", "link": "FirmwareLink.*:LinkedBoard.*-LinkedBoard.*OneByteOfTen"}

# (file, what is there once, what the mutant has instead)
MUTANTS = [
    ("device/add_ticks.cpp", "axis->phase < axis->velocity", "axis->phase <= axis->velocity"),
    ("device/engine.cpp", "begins_backward ? carries ^ all_of(ticks) : carries", "carries"),
    ("device/engine.cpp", "begins_backward != is_backward()", "false"),
    ("device/engine.hpp", "            execute(n);\n", ""),
    ("device/wide.hpp", "(low < one.low ? 1 : 0)", "0"),
    ("device/segment_queue.cpp", "header.pieces() >= loaded()", "header.pieces() > loaded()"),
    ("device/device.cpp", "next.is_frame(number) && may_run(number)", "next.is_frame(number)"),
    ("device/device.cpp", "words_.load(kVeto) <= frame", "words_.load(kVeto) < frame"),
    ("device/device.cpp", "frame.from(engine_.place().count) == engine_.place()", "true"),
    ("device/device.cpp", "direction < 0 ? setup().limit_min : setup().limit_max", "setup().limit_max"),
    ("device/device.cpp", "from.phase == kForwardPhase || from.phase == kBackwardPhase", "from.phase == kForwardPhase"),
    ("device/device.cpp", "        into_limit_ = true;\n", ""),
    ("device/device.cpp", "made < block.size || made == to_place", "made < block.size"),
    ("device/device.cpp", "phase_ != Phase::AtRest && has_lost_ticks_", "false"),
    ("device/device.cpp", "abilities_.has_encoder ? port_.encoder() : count_", "port_.encoder()"),
    ("device/device.cpp", "channels_.begin_tail(moment());", ""),
    ("device/channels.cpp", "is_next_known_ && pins == pins_ && ", "is_next_known_ && "),
    ("device/channels.cpp", "    is_next_known_ = false;\n    const bool is_well", "    const bool is_well"),
    ("device/channels.hpp", "        is_next_known_ = false;\n        outputs_", "        outputs_"),
    ("device/engine.cpp", "is_negative(last) == is_negative(gained)", "true"),
    ("device/output_queue.cpp", "list.changes[list.size - 1].at <= change.at", "list.changes[list.size - 1].at < change.at"),
    ("device/outputs.cpp", "tick + compare_ticks_", "tick + compare_ticks_ + 1"),
    ("device/host_watch.hpp", "heard_ = now;\n        is_silent_ = false;\n    }\n    /// The", "is_silent_ = false;\n    }\n    /// The"),
    ("device/inputs.cpp", "if ((pending_ & bit) == 0) { since_[n] = now; }", "since_[n] = now;"),
    ("device/capture.hpp", "sums += sum;", "sums += word;"),
    ("link/link.cpp", "    if (number != expected_) { return; }\n", ""),
    ("link/link.cpp", "now_us - progress_us_ < kRepeat_us", "true"),
    ("link/link.cpp", "header.from != peer_", "peer_ == 0"),
    ("link/frame.cpp", "crc == crc32(message_.bytes, end)", "true"),
    ("link/frame.cpp", "    is_full_run_ = true;\n", ""),
    ("link/board_words.cpp", "    if (!fill_ring(words, kStepsRing, motor, seen(kCaptureHead), steps_, items)) { return true; }\n", ""),
]


def detected(root, build, mutant):
    file, there, instead = mutant
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        shutil.copytree(root / FIRMWARE, work / FIRMWARE)
        source = (work / FIRMWARE / file).read_text()
        if source.count(there) != 1:
            sys.exit(f"{file} has `{there}` {source.count(there)} times, not once")
        (work / FIRMWARE / file).write_text(source.replace(there, instead))
        sources = sorted((work / FIRMWARE / "device").glob("*.cpp")) + sorted((work / FIRMWARE / "link").glob("*.cpp"))
        whole = work / "whole.cpp"
        whole.write_text("".join(f'#include "{path}"\n' for path in sources))
        library = work / "liblockstep_firmware.so"
        subprocess.run(["c++", "-std=c++20", "-O0", "-w", "-shared", "-fPIC", f"-I{work}", f"-I{root}", f"-I{build}",
                        whole, "-o", library], check=True)
        program = build / "bin" / "property_firmware"
        run = subprocess.run([program, "--gtest_fail_fast", f"--gtest_filter={TESTS[file.split('/')[0]]}"],
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
