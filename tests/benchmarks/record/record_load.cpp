// The recording part of one axis process, in real time: a generator instead of a device makes steps at a constant
// rate. They pass through the recorder to LCM and to the axis's own log. Prints the number of steps made.
#include <algorithm>
#include <chrono>
#include <iostream>

#include "services/arguments/argument_parser.hpp"
#include "services/documents/machine_file.hpp"
#include "services/record/axis_recorder.hpp"
#include "services/record/sinks.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/periodic.hpp"
#include "services/runtime/service_options.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {
namespace {

struct Load {
    std::string machine_file;
    std::string axis;
    std::int64_t rate = 100'000;  // steps/s
    double seconds = 2;
};

/// A motor at constant speed since `start`.
class Motor {
public:
    Motor(Tick start, Ticks period) : next_(start), period_(period) {}

    template <typename OnStep>
    void run(Tick to, OnStep&& on_step) {
        for (; next_ <= to; next_ += period_, ++steps_) { on_step(StepEdge{next_, 1}); }
    }
    std::int64_t steps() const { return steps_; }

private:
    Tick next_;
    Ticks period_;
    std::int64_t steps_ = 0;
};

int run(const Load& load, const MachineSetup& machine, std::size_t axis) {
    const MachineClock clock(machine.tick_ns, machine.timing.time_source);
    const Tick start = clock.now();
    const Tick end = start + Ticks{static_cast<std::int64_t>(load.seconds * machine.ticks_per_second())};
    Motor motor(start + Ticks{1}, {static_cast<std::int64_t>(machine.ticks_per_second()) / load.rate});
    auto sink = open_record(machine, load.axis, true);
    AxisRecorder recorder(machine, MotorIndex{axis}, static_cast<Identity>(monotonic_now().count()), *sink);

    StopSignal stop;
    PeriodicLoop periodic(loop_period(machine));
    std::int64_t slot = 0;
    periodic.run(stop, [&](std::chrono::nanoseconds) {
        const Tick now = std::min(clock.now(), end);
        AxisOutputs out;
        out.device_clock = {.own = now, .other = now};
        if (now.value / machine.slot_ticks().value != slot) {
            out.state = AxisState{.axis = static_cast<std::uint32_t>(axis), .tick = now};
            slot = now.value / machine.slot_ticks().value;
        }
        motor.run(now, [&](StepEdge step) { recorder.step(step); });
        if (out.state) { out.state->position = Position::steps(motor.steps()); }
        recorder.loop(out, 0, 0);
        if (now == end) { stop.request(); }
    });
    recorder.finish();
    std::cout << load.axis << ' ' << motor.steps() << std::endl;
    return sink->failures() == 0 ? 0 : 1;
}

}  // namespace
}  // namespace lockstep

int main(int argc, char** argv) {
    lockstep::ArgumentParser parser("Records one axis that makes steps at a constant rate, in real time.");
    lockstep::Load load;
    parser.add_option("--machine", load.machine_file, "the machine's configuration file").required();
    parser.add_option("--axis", load.axis, "the axis's name in that file").required();
    parser.add_option("--rate", load.rate, "steps/s").in_range(1, 500'000).with_default();
    parser.add_option("--seconds", load.seconds, "how long").in_range(0.01, 3600.0).with_default();
    parser.action([&] {
        const auto machine = lockstep::load_machine_file(load.machine_file);
        if (!machine) {
            std::cerr << lockstep::to_text(load.machine_file, machine.error());
            return 2;
        }
        const auto named =
            std::ranges::find(machine->axes, load.axis, [](const lockstep::AxisConfig& axis) { return axis.name; });
        if (named == machine->axes.end()) {
            std::cerr << load.machine_file << ": has no axis " << load.axis << '\n';
            return 2;
        }
        return lockstep::run(load, *machine, static_cast<std::size_t>(named - machine->axes.begin()));
    });
    return parser.run(argc, argv);
}
