#!/usr/bin/env python3
"""Changes the designs of sim_fpga/rtl one place at a time. The co-simulation must fail for each mutant.

Usage: run.py RTL_FOLDER BUILD [--long]    Prints each mutant that no test detects; exits 1 if there is one.
       --long    those of LONG_MUTANTS

A mutant's library has the name of the one that the test program is linked with, so LD_PRELOAD replaces that.
"""
import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

TEST_DIRECTORY = pathlib.Path(__file__).resolve().parent.parent
TIMEOUT_S = 300  # on a busy machine

# Which tests of a program concern a library or a file, where not all do.
TESTS = {
    "lai/line_download.v": "LineDownload.*",
    "motors/motors_host.v": "TwoMotors.TakeAWordBetweenTwoTicks*",
    "motors/motors_spi.v": "EightMotors.*",
    "motors/motors_start.v": "Board/OlimexHx8k.DoesNothingBeforeItsClockIsStable",
    "motors_spi_sram": "Board/OlimexHx8k.*",
    "icebreaker": "Board/Icebreaker.*",
    "two_axis_controller": "LaiHardware.*",
    "uart_receiver": "UartReceiver.*",
    "carrica_controller": "CarricaHardware.*",
    "phase_driver": "PhaseDriver.*",
    "axis_device": "AxisHardware.*",
    "motors_device_2": "TwoMotors.*",
    "motors_chip": "MotorsChip.*",
    "motors_chip_6": "SixMotorsOfAChip.*",
    "axis_pins": "AxisPins.*",
    "axis_pwm": "AxisPwm.*",
    "axis_chip": "AxisChip.*",
    "add_only_axis": "RanadeHardware.*",
    "add_only_engine_1": "EngineHardware/0.*",
    "add_only_engine_3": "EngineHardware/1.*",
    "add_only_engine_6": "EngineHardware/2.*",
}

# (library, file, what is there once, what the mutant has instead)
MUTANTS = [
    ("lam_controller", "lam/lam_delay.v", "left <= due ? next", "left <= due ? delay"),
    ("lam_controller", "lam/lam_delay.v", "cruising = shorter == CRUISE", "cruising = delay == CRUISE"),
    ("lam_controller", "lam/lam_location.v", "to_right ? rightward[BITS-1:0] : leftward", "rightward[BITS-1:0]"),
    ("lam_controller", "lam/lam_controller.v", "distance <= BRAKE + 1;", "distance <= BRAKE;"),
    ("lam_controller", "lam/lam_controller.v", "right ? right_limit : left_limit", "right_limit || left_limit"),
    ("lam_controller", "lam/lam_controller.v", "recovery == 0 && data_ready", "data_ready"),
    ("carrica_controller", "carrica/comparator.v", "FRACTION-COUNT_BITS] != 0", "FRACTION-COUNT_BITS+1] != 0"),
    ("carrica_controller", "carrica/reference_speed.v", "at_bound ? bound : next", "next"),
    ("carrica_controller", "carrica/reference_speed.v", "falling ? 0 : braking_at_max", "falling ? 0 : next_braking"),
    ("carrica_controller", "carrica/reference_speed.v", "else if (falling) slope <= LEVEL;", ""),
    ("carrica_controller", "carrica/reference_speed.v", "{1'b0, speed} + next[FRACTION+1:0]", "{speed, 1'b0}"),
    ("phase_driver", "drive/phase_driver.v", "backward ? eighth - turn : eighth + turn", "eighth + turn"),
    ("two_axis_controller", "lai/dda.v", "clock && next[8]", "clock && next[7]"),
    ("two_axis_controller", "lai/long_axis.v", "left <= fall)", "left < fall)"),
    ("two_axis_controller", "lai/short_axis.v", "free < least ? least : free", "free"),
    ("two_axis_controller", "lai/short_axis.v", "whole = more >=", "whole = more >"),
    ("two_axis_controller", "lai/whole_root.v", "rest < {7'd0, odd}", "rest <= {7'd0, odd}"),
    ("two_axis_controller", "lai/two_axis_planner.v", "limit_remaining ? root : wanted", "wanted"),
    ("two_axis_controller", "lai/line_download.v", "next_sum == 0", "1"),
    ("uart_receiver", "lai/uart_receiver.v", "valid <= level;", "valid <= 1;"),
    ("add_only_axis", "ranade/add_only_axis.v", "{1'b0, phase} + {1'b0, faster}", "{1'b0, phase} + {1'b0, velocity}"),
    ("add_only_engine_6", "ranade/add_only_engine.v", "(slot1 == VHI || slot1 == PHI) && carry1", "1'b0"),
    ("add_only_engine_1", "ranade/add_only_engine.v", "present[motor] <= !bank;", ""),
    ("add_only_engine_3", "ranade/add_only_engine.v", "run2 && slot2 != HOST", "slot2 != HOST"),
    ("add_only_engine_6", "ranade/add_only_engine.v", "!sum[LIMB] && b[LIMB-1]", "b[LIMB-1]"),
    ("axis_device", "axis/axis_sequencer.v", "is_armed <= armed >= number", "is_armed <= 1"),
    ("axis_device", "axis/axis_sequencer.v", "is_vetoed <= veto <= number", "is_vetoed <= veto < number"),
    ("axis_device", "axis/axis_sequencer.v", "!follows && tail_left != 0", "!follows && is_next && tail_left != 0"),
    ("motors_device_2", "motors/program/3_frames.asm", "    cmp ARMED, NUMBER\n    jnc return\n", ""),
    ("motors_device_2", "motors/motors_host.v", "begun || is_ring || may_write", "1'b1"),
    ("motors_chip", "motors/motors_pins.v", "unit == found[7:0]", "unit == 0"),
    ("motors_spi_sram", "motors/motors_spi.v", "if (is_right) write", "if (1'b1) write"),
]

LONG_MUTANTS = [
    ("motors_device_2", "motors/program/3_frames.asm", "    cmp NUMBER, VETO\n    jc return\n", ""),
    ("motors_device_2", "motors/program/3_frames.asm", "    cmp REQUEST, RUN\n    jnz return\n", ""),
    ("motors_device_2", "motors/program/3_frames.asm", "    cmp C, B\n    jnc return\n", ""),
    ("motors_device_2", "motors/program/3_frames.asm", "    tst TAG[0], #2\n", "    tst TAG[0], #1\n"),
    ("motors_device_2", "motors/program/1_tick.asm", "    jstep step\n", "    jc step\n"),
    ("motors_device_2", "motors/program/1_tick.asm", "    tst SEEN, #AT_MAX\n    jnz into_limit\n", ""),
    ("motors_device_2", "motors/program/1_tick.asm", "    joverflow overflow\n", ""),
    ("motors_device_2", "motors/program/1_tick.asm", "    jlate late\n", ""),
    ("motors_device_2", "motors/program/1_tick.asm", "    add CAPTURE_SUMS, CAPTURE_SUM\n", ""),
    ("motors_device_2", "motors/program/4_inputs.asm", "    andn PENDING, CHANGED\n", ""),
    ("motors_device_2", "motors/program/5_outputs.asm", "    add B, BASE\n", ""),
    ("motors_device_2", "motors/program/5_outputs.asm", "    cmp B, LAST_IN_TAIL\n    jnc change_is_bad\n", ""),
    ("motors_device_2", "motors/program/6_setup.asm", "    tst A[2], #0xff & ~((1 << ANALOG) - 1)\n    jnz refuse\n", ""),
    ("motors_chip", "motors/motors_pins.v", "(begins && steps)", "begins"),
    ("motors_chip_6", "motors/motors_pins.v", "seen == 7 && !began", "seen == 7"),
    ("motors_chip_6", "motors/motors_core.v", "is_late <= overruns", "is_late <= is_tick"),
    ("motors_spi_sram", "motors/motors_spi.v", "accepts <= crc == 0 &&", "accepts <="),
    ("motors_spi_sram", "motors/motors_spi.v", "count == 63 && write)", "1'b0)"),
    ("motors_spi_sram", "motors/motors_sram.v", "we_n <= !pulses", "we_n <= !oe_n"),
    ("motors_spi_sram", "motors/motors_start.v", "begun = periods[12]", "begun = 1'b1"),
    ("icebreaker", "boards/icebreaker.v", "~switches_n", "switches_n"),
    ("motors_chip", "motors/motors_analog.v", "{1'b0, its_rest}", "16'd0"),
    ("axis_device", "axis/axis_sequencer.v", "is_of_request <= run_request == run", "is_of_request <= 1"),
    ("axis_device", "axis/axis_adder.v", "is_now <= is_equal;", "is_now <= 1;"),
    ("axis_device", "axis/axis_adder.v", "? !addend[63] : sum[64]; // signed", "? !addend[63] : 1'b1;"),
    ("axis_device", "axis/axis_sequencer.v", "is_same_phase || (motion == WAITING && is_rest_phase)", "is_same_phase || is_rest_phase"),
    ("axis_device", "axis/axis_sequencer.v", "state == STEP && engine_step && !is_blocked", "state == STEP && engine_step"),
    ("axis_device", "axis/axis_sequencer.v", "(ends && into_limit);", "1'b0;"),
    ("axis_device", "axis/axis_sequencer.v", "enabled_for >= enable_ticks", "enabled_for > enable_ticks"),
    ("axis_device", "axis/axis_sequencer.v", "(is_stopped ? BY_INPUT : 16'd0);", "16'd0;"),
    ("axis_device", "axis/axis_sequencer.v", "start_setup = state == SETUP && setup_is_new && !in_motion",
     "start_setup = state == SETUP && setup_is_new"),
    ("axis_device", "axis/axis_sequencer.v", "tick && in_motion && (", "tick && ("),
    ("axis_device", "axis/axis_sequencer.v", "is_stop_asked || has_lost_ticks", "is_stop_asked"),
    ("axis_device", "axis/axis_frame_scanner.v", "is_whole = pieces <", "is_whole = 1 || pieces <"),
    ("axis_device", "axis/axis_frame_scanner.v", "is_well <= is_piece;", "is_well <= 1;"),
    ("axis_device", "axis/axis_frame_scanner.v", "(is_of_run ? drop_own : drop_others)", "(!is_of_run && drop_others)"),
    ("axis_device", "axis/axis_adder.v", "state == TRAVELLED && sum[64] != addend[63]", "state == TRAVELLED && sum[64]"),
    ("axis_device", "axis/axis_adder.v", "overflow <= addend[63] == counted_word[63] &&", "overflow <="),
    ("axis_device", "axis/axis_inputs.v", "now - since_word >= debounce_word", "now - since_word > debounce_word"),
    ("axis_pins", "axis/axis_pins.v", "hold_left == 0 && !is_on", "!is_on"),
    ("axis_pins", "axis/axis_pins.v", "is_free && setup_left == 0", "is_free"),
    ("axis_pins", "axis/axis_pins.v", "is_pause <= is_on;", "is_pause <= 0;"),
    ("axis_pwm", "axis/axis_pwm.v", "at + 1'b1 >= period", "at >= period"),
    ("axis_pwm", "axis/axis_pwm.v", "factor[16:1] == 1) next_on", "factor[16:1] == 2) next_on"),
    ("axis_chip", "axis/axis_chip.v", ".tick(tick), .step(step), .forward(forward)",
     ".tick(tick), .step(step), .forward(!forward)"),
    ("axis_device", "axis/axis_inputs.v", "busy = scans || wait_for_event", "busy = scans"),
    ("axis_device", "axis/axis_inputs.v", "!asked && !wait_for_event", "!asked"),
    ("axis_device", "axis/axis_shown.v", "note_is_lost <= notes_full;", "note_is_lost <= 0;"),
    ("axis_device", "axis/axis_adder.v", "read = CAPTURE_SUMS;", "read = CAPTURE_SUM;"),
    ("axis_device", "axis/axis_shown.v", "step_is_lost <= capture_full;", "step_is_lost <= 0;"),
    ("axis_device", "axis/axis_host_watch.v", "ticks >= patience", "ticks > patience"),
    ("axis_device", "axis/axis_outputs.v", "is_active <= is_usable && !is_host_silent", "is_active <= is_usable"),
    ("axis_device", "axis/axis_outputs.v", "word[42:0] > since", "word[42:0] >= since"),
    ("axis_device", "axis/axis_outputs.v", "(levels & ~new_mask)", "levels"),
    ("axis_device", "axis/axis_adder.v", "is_nothing || is_below", "is_below"),
    ("axis_device", "axis/axis_adder.v", "sum[63:62] != 0", "sum[63]"),
    ("axis_device", "axis/axis_outputs.v", "is_safe_asked <= silence || is_cut", "is_safe_asked <= is_cut"),
    ("axis_device", "axis/axis_outputs.v", "channel <= {2'd0, due_channel};", ""),
    ("axis_device", "axis/axis_output_ring.v", "word[42:0] >= last", "word[42:0] > last"),
    ("axis_device", "axis/axis_output_ring.v", "is_found ? its_first : at", "at"),
    ("axis_device", "axis/axis_output_ring.v", "kind == 1 && {29'd0, channel} < ANALOG", "kind == 1"),
    ("axis_device", "axis/axis_output_ring.v", "if (!of_run) state <= STOP;", "if (0) state <= STOP;"),
    ("axis_device", "axis/axis_sequencer.v", "reason != 0 || motion != BODY || !is_last", "reason != 0"),
    ("axis_device", "axis/axis_setup.v", "refused = state == CHECK && asked && !is_possible", "refused = 1'b0"),
]


def verilated(build, library):
    """The folder in which CMake has verilated this library, and the test program beside it."""
    out = next(build.glob(f"tests/rtl/*/verilated/{library}"))
    return out, build / "bin" / f"rtl_{out.parent.parent.name}"


def mutated(rtl, work, file, there, instead):
    folder = work / "rtl"
    shutil.copytree(rtl, folder)
    shutil.copy(rtl.parent / "registers.vh", work)
    source = (folder / file).read_text()
    if source.count(there) != 1:
        sys.exit(f"{file} has `{there}` {source.count(there)} times, not once")
    (folder / file).write_text(source.replace(there, instead))
    if file.endswith(".asm"):
        subprocess.run([folder / "motors" / "assemble.py"], check=True)
    return folder


def flags_of_models(work):
    """The compiler's flags of a mutant's model. Verilator's header, which takes most of its compilation, is precompiled
    here, with the options that tests/rtl/verilate gives, as otherwise the compiler refuses it."""
    root = subprocess.run(["verilator", "--getenv", "VERILATOR_ROOT"], capture_output=True, text=True, check=True)
    include = f"{root.stdout.strip()}/include"
    header = pathlib.Path(work) / "runtime.hpp"
    header.write_text("#include <verilated.h>\n")
    subprocess.run([os.environ.get("CXX", "g++"), "-std=c++20", "-O0", "-shared", "-fPIC", f"-I{include}", "-isystem",
                    f"{include}/vltstd", "-x", "c++-header", header, "-o", f"{header}.gch"], check=True)
    return f"-O0 -include {header} -Werror=invalid-pch"


def detected(rtl, build, flags, mutant):
    library, file, there, instead = mutant
    out, program = verilated(build, library)
    with tempfile.TemporaryDirectory() as work:
        folder = mutated(rtl, pathlib.Path(work), file, there, instead)
        top, name, part, *options = (out / "arguments").read_text().splitlines()
        subprocess.run([TEST_DIRECTORY / "verilate", f"{work}/out", top, name, folder / pathlib.Path(part).name,
                        *options, "-Wno-fatal"],
                       env={**os.environ, "MODEL_FLAGS": flags}, stderr=subprocess.DEVNULL, check=True)
        try:
            tests = TESTS.get(file) or TESTS.get(library, "*")
            run = subprocess.run([program, "--gtest_fail_fast", f"--gtest_filter={tests}"],
                                 env={**os.environ, "LD_PRELOAD": f"{work}/out/libV{name}.so"},
                                 capture_output=True, timeout=TIMEOUT_S, check=False)
        except subprocess.TimeoutExpired:
            sys.exit(f"{file}: with `{instead}` the test does not end")
        return run.returncode == 1  # a test failed


def main():
    rtl, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    mutants = LONG_MUTANTS if "--long" in sys.argv else MUTANTS
    with tempfile.TemporaryDirectory() as work, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        flags = flags_of_models(work)
        found = list(pool.map(lambda mutant: detected(rtl, build, flags, mutant), mutants))
    for (_, file, there, instead), was_detected in zip(mutants, found):
        if not was_detected:
            print(f"{file}: no test notices `{instead}` in place of `{there}`")
    print(f"{sum(found)} of {len(found)} mutants are detected")
    return 0 if all(found) else 1


if __name__ == "__main__":
    sys.exit(main())
