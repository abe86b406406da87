// Records of machines with clocks of their own, bad networks, other planners and other axes.
#include "services/documents/machine_file.hpp"
#include "tests/records/kinds/kinds.hpp"

namespace lockstep::records {
namespace {

const std::string kTour = "G21 G90 F3000\nG1 X40 Y8\nX42 Y40\nG0 X10 Y40\nX5 Y5\n";
const std::string kArc = "G21 G90\nG0 X20 Y20\nG2 X40 Y20 I10 J0 F2400\nG1 X5 Y5\n";

void run_job(MachineRun& run, const std::string& gcode, bool is_held) {
    run.home();
    run.begin(gcode);
    if (is_held) {
        run.wait_ms(600);
        run.hold();
        run.resume();
    }
    run.to_rest();
}

Record recorded(const VirtualOptions& options, const std::string& gcode, bool is_held = false) {
    MachineRun run(options);
    run_job(run, gcode, is_held);
    run.move_own("G0 X12 Y9\n");
    run.wait_ms(200);
    return run.finish();
}

/// Datagrams between the processes are lost, late and repeated; the record is whole.
VirtualOptions rough_network() {
    VirtualOptions options = options_of(small_plotter());
    options.seed = 7;
    options.network = {.delay_min = Ticks{50}, .delay_max = Ticks{15'000}, .duplicated = 0.05, .lost = 0.05};
    return options;
}

VirtualOptions lai_planner() {
    MachineSetup machine = small_plotter();
    machine.coordination = StepMethod::Lai;
    return options_of(machine);
}

Record by_motors(const MachineSetup& machine, const std::string& gcode, bool is_held = false) {
    MachineRun run(machine);
    run_job(run, gcode, is_held);
    run.wait_ms(200);
    return run.finish();
}

/// A mirrored motor with a gear, and guides that are not square.
MachineSetup geared() {
    MachineSetup machine = small_core_xy();
    machine.kinematics = {.matrix = {{.motor = "Y", .of = {{.axis = "Y", .factor = -1.25}}}},
                          .skews = {{.x = "X", .y = "Y", .mm_per_m = 4}}};
    return read_again(machine);
}

VirtualOptions rotary() {
    MachineSetup machine = small_plotter();
    machine.axes[1].name = "A";
    return options_of(machine);
}

Record six_axes() {
    MachineRun run(example_machine("six-axis"));
    run.home();
    run.run("G0 X30 Y20 Z50 A0 B10 C-90\nG0 X5 Y5 Z58 A-174 B-84 C-174\n");
    return run.finish();
}

Record sent_in_parts() {
    MachineRun run(small_plotter());
    run.home();
    std::string gcode = "G64\nG1 F3000\n";
    for (int i = 1; i <= 400; ++i) {
        gcode += "X" + std::to_string(5 + 0.1 * i) + " Y" + std::to_string(5 + 0.002 * i * (i % 40)) + "\n";
    }
    run.run_in_parts(gcode, 60);
    run.wait_ms(200);
    return run.finish();
}

/// Inputs of one probe, at the devices of these motors; several see one switch.
std::vector<InputConfig> probe_at(const std::vector<std::string>& motors) {
    std::vector<InputConfig> inputs;
    for (const std::string& motor : motors) {
        inputs.push_back({.name = "probe" + motor,
                          .motor = motor,
                          .channel = 3,
                          .use = InputUse::Probe,
                          .number = 0,
                          .max_overshoot_mm = 20,
                          .wire = motors.size() > 1 ? "tip" : ""});
    }
    return inputs;
}

/// A probe at the devices of these motors touches in a slow move to this place, and the next program goes back.
Record probed(VirtualOptions options, const std::string& place, const std::vector<std::string>& motors = {"X"}) {
    options.machine.inputs = probe_at(motors);
    MachineRun run(options);
    run.home();
    run.begin("G38.2 " + place + " F300\n");
    run.wait_ms(700);
    for (std::size_t i = 0; i < motors.size(); ++i) { run.vm().set_input(i, true); }
    run.to_rest();
    for (std::size_t i = 0; i < motors.size(); ++i) { run.vm().set_input(i, false); }
    run.wait_ms(100);
    run.run("G0 X5 Y5\n");
    run.wait_ms(200);
    return run.finish();
}

/// The switch is wired to both motors, and one of the wires is broken: its motor goes on until the veto.
Record probed_by_a_broken_wire() {
    VirtualOptions options = options_of(small_plotter());
    options.machine.inputs = probe_at({"X", "Y"});
    MachineRun run(options);
    run.home();
    run.begin("G38.2 X20 Y9 F300\n");
    run.wait_ms(700);
    run.vm().set_input(0, true);
    run.wait_ms(1000);
    return run.finish();
}

}  // namespace

std::vector<RecordKind> machine_kinds() {
    // A network may interrupt the motion; the machine continues it.
    const Expected interrupted{kSaysGood, kSaysGood | kSaysDoubtful, kSaysGood, kSaysGood};
    return {
        {"own_clocks", [] { return recorded(own_clocks(small_plotter()), kTour); }},
        {"own_clocks_with_arcs", [] { return recorded(own_clocks(small_plotter()), kArc); }},
        {"own_clocks_and_a_hold", [] { return recorded(own_clocks(small_plotter()), kTour, true); }},
        {"rough_network", [] { return recorded(rough_network(), kTour); }, interrupted},
        {"lai_planner", [] { return recorded(lai_planner(), kTour); }},
        {"lai_planner_and_a_hold", [] { return recorded(lai_planner(), kTour, true); }},
        {"rotary_axis",
         [] {
             MachineRun run(rotary());
             run.home();
             run.run("G0 X20 A30\nG1 X30 A90 F3000\nA10\nX5\n");
             return run.finish();
         }},
        {"core_xy", [] { return by_motors(small_core_xy(), kTour); }},
        {"core_xy_with_arcs", [] { return by_motors(small_core_xy(), kArc); }},
        {"core_xy_and_a_hold", [] { return by_motors(small_core_xy(), kArc, true); }},
        {"core_xy_with_own_clocks",
         [] {
             MachineRun run(own_clocks(small_core_xy()));
             run.home();
             run.run(kArc);
             run.wait_ms(200);
             return run.finish();
         }},
        {"gantry", [] { return by_motors(small_gantry(), kTour); }},
        {"gantry_with_arcs", [] { return by_motors(small_gantry(), kArc); }},
        {"gantry_and_a_hold", [] { return by_motors(small_gantry(), kTour, true); }},
        {"geared_and_skewed_motors", [] { return by_motors(geared(), kArc); }},
        {"six_axes", six_axes},
        {"program_sent_in_parts", sent_in_parts},
        {"touch_in_a_move_of_two_axes", [] { return probed(options_of(small_plotter()), "X20 Y9"); }},
        {"touch_at_which_pulses_cease", [] { return probed(options_of(small_plotter()), "X20"); }},
        {"touch_at_which_the_pulses_of_a_gantry_cease",
         [] {
             return probed(options_of(small_gantry()), "X20", {"X", "X2"});
         }},
        {"touch_at_which_the_pulses_of_belts_cease",
         [] {
             return probed(options_of(small_core_xy()), "X20", {"X", "Y"});
         }},
        {"touch_that_a_device_misses", probed_by_a_broken_wire, kLeftPath},
        {"touch_at_which_pulses_cease_by_own_clock", [] { return probed(own_clocks(small_plotter()), "X20"); }},
    };
}

}  // namespace lockstep::records
