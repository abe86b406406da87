// Records in which processes end and others take their place.
#include "tests/records/kinds/kinds.hpp"

namespace lockstep::records {
namespace {

const std::string kLine = "G21 G90 F3000\nG1 X60 Y50\nX9 Y40\nX5 Y5\n";

/// The job fails. Its steps are as planned, as far as they are known.
constexpr Expected kEndedInMotion{kSaysGood | kSaysUnknown, kSaysDoubtful | kSaysUnknown | kSaysBad,
                                  kSaysGood | kSaysUnknown, kSaysGood | kSaysUnknown};

/// Another coordinator goes on with the job. Nothing need be missing.
constexpr Expected kContinued{kSaysGood | kSaysUnknown, kSaysGood | kSaysDoubtful | kSaysUnknown,
                              kSaysGood | kSaysUnknown, kSaysGood | kSaysUnknown};

/// A process is killed at rest; the next one takes its place. Nothing is missing.
Record restarted_at_rest(std::size_t process) {
    MachineRun run(small_plotter());
    run.home();
    run.run("G1 X20 Y10 F3000\n");
    run.wait_ms(1500);
    run.restart(process, 400);
    run.wait_ms(2500);
    run.reset();
    run.home();
    run.run("G1 X20 Y10 F3000\n");
    return run.finish();
}

Record killed_in_motion(std::size_t process, std::int64_t into_ms, std::int64_t dead_ms) {
    MachineRun run(small_plotter());
    run.home();
    run.begin(kLine);
    run.wait_ms(into_ms);
    run.restart(process, dead_ms);
    run.wait_ms(2500);
    return run.finish();
}

const char* const kBurn = "G21 G90 F2400\nM4 S600\nG1 X30 Y8\nM62 P1\nX9 Y9\nM63 P1\nM5\n";

/// The motor of a laser is killed at rest. The next process numbers its changes from 0.
Record laser_motor_restarted() {
    MachineRun run(small_laser());
    run.home();
    run.run(kBurn);
    run.wait_ms(1500);
    run.restart(0, 400);
    run.wait_ms(2500);
    run.reset();
    run.home();
    run.run(kBurn);
    run.wait_ms(300);
    return run.finish();
}

/// The motor of a laser is killed while the laser burns.
Record laser_motor_killed() {
    MachineRun run(small_laser());
    run.home();
    run.begin(kBurn);
    run.wait_ms(555);
    run.restart(0, 10'000);
    run.wait_ms(2500);
    return run.finish();
}

Record taken_over(OnTakeover on_takeover) {
    VirtualOptions options = options_of(small_plotter());
    options.coordinators = 2;
    options.on_takeover = on_takeover;
    MachineRun run(options);
    run.home();
    run.begin(kLine);
    run.wait_ms(500);
    run.restart(*run.vm().owner(), 20'000);
    run.wait_ms(2500);
    run.to_rest();
    run.wait_ms(500);
    return run.finish();
}

}  // namespace

std::vector<RecordKind> process_kinds() {
    const Expected at_rest{kSaysGood, kSaysGood | kSaysDoubtful, kSaysGood, kSaysGood};
    return {
        {"axis_restarted_at_rest", [] { return restarted_at_rest(1); }, at_rest},
        {"coordinator_restarted_at_rest", [] { return restarted_at_rest(2); }, at_rest},
        {"axis_killed_in_motion", [] { return killed_in_motion(1, 555, 10'000); }, kEndedInMotion},
        {"axis_killed_and_restarted_in_motion", [] { return killed_in_motion(1, 760, 400); }, kEndedInMotion},
        {"coordinator_killed_in_motion", [] { return killed_in_motion(2, 555, 10'000); }, kEndedInMotion},
        {"laser_motor_restarted_at_rest", laser_motor_restarted, at_rest},
        {"laser_motor_killed_in_motion", laser_motor_killed, kEndedInMotion},
        {"takeover_that_stops", [] { return taken_over(OnTakeover::Stop); }, kEndedInMotion},
        {"takeover_that_continues", [] { return taken_over(OnTakeover::Continue); }, kContinued},
    };
}

}  // namespace lockstep::records
