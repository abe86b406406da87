// Records of jobs that people and programs interrupt.
#include "tests/records/kinds/kinds.hpp"

namespace lockstep::records {
namespace {

const std::string kSquare = "G21 G90 F3000\nG1 X40 Y8\nX42 Y40\nG4 P0.1\nG0 X10 Y40\nX5 Y5\n";
const std::string kArcs = "G21 G90\nG0 X20 Y20\nG2 X40 Y20 I10 J0 F2400\nG3 X60 Y20 I10 J0\nG1 X5 Y5\n";

/// A stopped job is doubtful. Its steps are as planned.
constexpr Expected kStopped{kSaysGood, kSaysDoubtful, kSaysGood, kSaysGood};

/// Homes, begins the program and drives it; the rest of the program runs to its end.
RecordKind driven(std::string name, const std::string& gcode, std::function<void(MachineRun&)> drive,
                  const Expected& expected = kValid) {
    return {std::move(name),
            [=] {
                MachineRun run(small_plotter());
                run.home();
                run.begin(gcode);
                drive(run);
                run.to_rest();
                run.wait_ms(200);
                return run.finish();
            },
            expected};
}

RecordKind held_at(const std::string& name, const std::string& gcode, std::int64_t ms) {
    return driven(name, gcode, [=](MachineRun& run) {
        run.wait_ms(ms);
        run.hold();
        run.resume();
    });
}

void turn_often(MachineRun& run) {
    for (const int percent : {50, 130, 20, 200, 100}) {
        run.wait_ms(230);
        run.set_overrides({percent, percent});
    }
}

Record emergency_stops() {
    MachineRun run(small_plotter());
    run.home();
    run.run("G1 X20 Y20 F3000\n");
    run.command(CommandKind::EmergencyStop);  // at rest
    run.reach(MachinePhase::Fault);
    run.reset();
    run.home();
    run.begin(kSquare);
    run.wait_ms(700);
    run.command(CommandKind::EmergencyStop);  // in motion
    run.reach(MachinePhase::Fault);
    run.reset();
    run.home();
    run.run("G1 X20 Y20 F3000\n");
    return run.finish();
}

Record jobs_of_all_kinds() {
    MachineRun run(small_mill());
    run.home();
    run.run("M3 S900\n" + kArcs + "M5\n");
    run.move_own("G0 X30 Y20\n");
    run.begin(kSquare);
    run.wait_ms(500);
    run.hold();
    run.set_overrides({80, 60});
    run.resume();
    run.to_rest();
    run.jog(0, 12, 400);
    run.run("G1 X5 Y5 F3000\n");
    return run.finish();
}

}  // namespace

std::vector<RecordKind> interruption_kinds() {
    const std::string events = "M3 S1200\nG1 X20 F3000\nM62 P1\nX40\nM63 P1\nM8\nG1 Y30\nM67 E2 Q0.5\nX5\nM9\nM5\n";
    return {
        driven("pause", "G0 X40 Y10\nM0\nG0 X5 Y5\n",
               [](MachineRun& run) {
                   run.reach(MachinePhase::Paused);
                   run.resume();
               }),
        driven("jogs_in_a_pause", "G0 X40 Y10\nM0\nG0 X5 Y5\n",
               [](MachineRun& run) {
                   run.reach(MachinePhase::Paused);
                   run.jog(0, 12, 400);
                   run.jog(1, 8, 300);
                   run.return_and_resume();
               }),
        driven("events", events, [](MachineRun&) {}),
        driven("override_in_motion", kSquare, turn_often),
        driven("override_in_arcs", kArcs, turn_often),
        held_at("hold_at_the_beginning", kSquare, 0),
        held_at("hold_in_a_line", kSquare, 450),
        held_at("hold_in_an_arc", kArcs, 900),
        held_at("hold_with_events", events, 600),
        driven("hold_twice", kSquare,
               [](MachineRun& run) {
                   for (int i = 0; i < 2; ++i) {
                       run.wait_ms(400);
                       run.hold();
                       run.resume();
                   }
               }),
        driven(
            "stop", kSquare,
            [](MachineRun& run) {
                run.wait_ms(600);
                run.command(CommandKind::Stop);
            },
            kStopped),
        driven(
            "stop_in_an_arc", kArcs,
            [](MachineRun& run) {
                run.wait_ms(1000);
                run.command(CommandKind::Stop);
            },
            kStopped),
        {"emergency_stops_at_rest_and_in_motion", emergency_stops, kFailed},
        {"jobs_of_all_kinds", jobs_of_all_kinds},
    };
}

}  // namespace lockstep::records
