// Records of homing, of moves that axes make on their own, and of jogs.
#include "tests/records/kinds/kinds.hpp"

namespace lockstep::records {
namespace {

/// The example of two axes, whose limits suit the method.
MachineSetup machine_for(StepMethod method) {
    MachineSetup machine = small_plotter();
    for (AxisConfig& axis : machine.axes) {
        axis.method = method;
        if (method == StepMethod::Lai) { axis.max_velocity_mm_s = 40; }
        if (method == StepMethod::Lam) { axis.start_velocity_mm_s = axis.max_velocity_mm_s = 15; }
    }
    return machine;
}

RecordKind by_method(const std::string& name, StepMethod method) {
    return {"own_moves_" + name,
            [method] {
                MachineRun run(machine_for(method));
                run.home();
                run.move_own("G0 X30 Y8\n");
                run.begin_own("G0 X150 Y120\n");
                run.wait_ms(500);
                run.command(CommandKind::Stop);
                run.to_rest();
                return run.finish();
            },
            {kSaysGood, kSaysDoubtful, kSaysGood, kSaysGood}};
}

Record homed(const MachineSetup& machine) {
    MachineRun run(machine);
    run.home();
    run.wait_ms(300);
    return run.finish();
}

Record homed_twice() {
    MachineRun run(small_plotter());
    run.home();
    run.run("G1 X20 Y10 F3000\n");
    run.home();
    run.home({AxisIndex{1}});
    run.run("G1 X20 Y10 F3000\n");
    return run.finish();
}

/// The motors of the belts take their places as those of the park position, again and again. No step follows the last
/// homing.
Record homed_in_place_again() {
    MachineRun run(small_core_xy());
    run.home();
    run.run("G1 X20 Y10 F3000\n");
    run.home();
    run.run("G1 X20 Y10 F3000\n");
    run.home();
    run.wait_ms(300);
    return run.finish();
}

/// Only X moves after homing; the log goes on for seconds.
Record y_at_rest_after_homing() {
    MachineRun run(small_plotter());
    run.home();
    run.run("G1 X40 F3000\nX10\n");
    run.wait_ms(3000);
    return run.finish();
}

/// The axes wait on their switches, so that their last steps are made before their zero is set.
MachineSetup parked_on_switches() {
    MachineSetup machine = small_plotter();
    for (AxisConfig& axis : machine.axes) {
        axis.homing.switch_position_mm = axis.homing.park_mm = 0;
        axis.plant.start_position_mm = 8;
    }
    return machine;
}

Record x_moves_alone_from_its_switch() {
    MachineRun run(parked_on_switches());
    run.home();
    run.run("G1 X20 F3000\n");
    run.wait_ms(500);
    return run.finish();
}

/// Short jobs, one directly after the other.
Record short_moves() {
    MachineRun run(small_plotter());
    run.home();
    for (const char* gcode : {"G0 X6 Y6\n", "G0 X7\n", "G0 X8\n", "G0 Y7\n", "G0 X9\n", "G0 X10\n"}) {
        run.move(gcode);
    }
    return run.finish();
}

Record jogs() {
    MachineRun run(small_plotter());
    run.home();
    run.jog(0, 20, 500);
    run.jog(1, 8, 300);
    run.jog(0, -20, 200);
    return run.finish();
}

Record own_moves_of_one_axis() {
    MachineRun run(small_plotter());
    run.home();
    run.move_own("G0 X12\n");
    run.wait_ms(500);
    return run.finish();
}

}  // namespace

std::vector<RecordKind> own_move_kinds() {
    return {
        by_method("ranade", StepMethod::Ranade),
        by_method("spielauer", StepMethod::Spielauer),
        by_method("lai", StepMethod::Lai),
        by_method("lam", StepMethod::Lam),
        by_method("carrica", StepMethod::Carrica),
        {"own_move_of_one_axis", own_moves_of_one_axis},
        {"homing_only", [] { return homed(small_mill()); }},
        {"homing_from_afar", [] { return homed(example_machine("two-axis")); }},
        {"homing_again", homed_twice},
        {"homing_in_place_again", homed_in_place_again},
        {"axis_without_steps_after_homing", y_at_rest_after_homing},
        {"homing_to_the_switches", [] { return homed(parked_on_switches()); }},
        {"one_axis_stays_on_its_switch", x_moves_alone_from_its_switch},
        {"short_moves_one_after_the_other", short_moves},
        {"jogs", jogs},
    };
}

}  // namespace lockstep::records
