// The valid records that are altered. Each has homing, a program and an own move.
#include "tests/records/alterations/alterations.hpp"
#include "tests/records/machine_run.hpp"

namespace lockstep::records {
namespace {

Record lines() {
    MachineRun run(small_plotter());
    run.home();
    run.run("G21 G90 F3000\nM3 S900\nG1 X30 Y8\nM62 P1\nX32 Y20\nM63 P1\nG4 P0.1\nG1 X10 Y20\nM5\nX5 Y5\n");
    run.move_own("G0 X14 Y9\n");
    run.run("G1 X5 Y5 F3000\n");
    run.wait_ms(300);
    return run.finish();
}

Record held_lines() {
    MachineRun run(small_plotter());
    run.home();
    run.begin("G21 G90 F2400\nG1 X30 Y8\nX32 Y20\nX5 Y5\n");
    run.wait_ms(500);
    run.set_overrides({60, 100});
    run.wait_ms(200);
    run.hold();
    run.resume();
    run.to_rest();
    run.move_own("G0 X14 Y9\n");
    run.wait_ms(300);
    return run.finish();
}

Record arcs() {
    MachineRun run(small_plotter());
    run.home();
    run.run("G21 G90\nG0 X20 Y20\nG2 X32 Y20 I6 J0 F2400\nG1 X12 Y12\n");
    run.move_own("G0 X5 Y5\n");
    run.wait_ms(300);
    return run.finish();
}

Record clocks() {
    MachineRun run(own_clocks(small_plotter()));
    run.home();
    run.run("G21 G90 F3000\nG1 X30 Y8\nX32 Y20\nX5 Y5\n");
    run.move_own("G0 X14 Y9\n");
    run.wait_ms(300);
    return run.finish();
}

Record parts() {
    MachineRun run(small_plotter());
    run.home();
    std::string gcode = "G64\nG1 F3000\n";
    for (int i = 1; i <= 150; ++i) {
        gcode += "X" + std::to_string(5 + 0.15 * i) + " Y" + std::to_string(5 + 0.0006 * i * i) + "\n";
    }
    run.run_in_parts(gcode, 50);
    run.move_own("G0 X14 Y9\n");
    run.wait_ms(300);
    return run.finish();
}

const std::string kLinesAndArc = "G21 G90 F2400\nG1 X30 Y8\nX32 Y20\nG0 X20 Y20\nG2 X32 Y20 I6 J0\nG1 X5 Y5\n";

Record belts() {
    MachineRun run(small_core_xy());
    run.home();
    run.run(kLinesAndArc);
    run.move_own("G0 Z9\n");
    run.wait_ms(300);
    return run.finish();
}

Record gantry() {
    MachineRun run(small_gantry());
    run.home();
    run.run(kLinesAndArc);
    run.move_own("G0 Y14\n");
    run.wait_ms(300);
    return run.finish();
}

/// A laser that follows the speed, a valve, and a camera with pulses at places, of which some are left at the end, in a
/// program with a hold.
Record outputs() {
    MachineRun run(with_camera(small_laser()));
    run.home();
    run.begin(
        "G21 G90 F2400\nM4 S600\nM69 P0 Q6 R0.5 L27\nG1 X30 Y8\nM62 P1\nX32 Y20\nS200\nM63 P1\nM69 P0 Q19 R-0.5 L36\n"
        "X5 Y5\nM62 P1\nX9\nM63 P1\nM5\n");
    run.wait_ms(500);
    run.hold();
    run.resume();
    run.to_rest();
    run.move_own("G0 X14 Y9\n");
    run.wait_ms(300);
    return run.finish();
}

}  // namespace

const std::vector<Base>& bases() {
    static const std::vector<Base> all{
        {"lines", lines, {.events = true, .shared_clock = true, .whole_program = true, .all_motions = true}},
        {"held_lines", held_lines, {.overrides = true, .shared_clock = true, .whole_program = true}},
        {"arcs", arcs, {.shared_clock = true, .whole_program = true}},
        {"own_clocks", clocks, {.clocks = true, .whole_program = true, .all_motions = true}},
        {"sent_in_parts", parts, {.parts = true, .shared_clock = true}},
        {"core_xy", belts, {.shared_clock = true, .whole_program = true}},
        {"gantry", gantry, {.shared_clock = true, .whole_program = true}},
        {"outputs", outputs, {.outputs = true}},
    };
    return all;
}

}  // namespace lockstep::records
