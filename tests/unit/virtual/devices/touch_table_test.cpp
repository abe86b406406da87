// The table of measured touches in docs/protocol.md: how far probing moves go on behind a touch, and how far the
// reported place is from the true one, in simulated machines of three timings.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "core/coordinator/program/probe_check.hpp"
#include "tests/unit/virtual/devices/probing_rig.hpp"
#include "tests/unit/virtual/true_clocks.hpp"

namespace lockstep {
namespace {

constexpr double kTableFeed_mm_s = 5;
constexpr int kTableMoves = 40;

/// X moves, and the probe is wired to the device of Y.
MachineConfig probe_elsewhere(const ProtocolTiming& timing) {
    MachineConfig machine = small_machine();
    machine.timing = timing;
    machine.inputs = {
        {.name = "probe", .motor = "Y", .channel = 3, .use = InputUse::Probe, .number = 0, .max_overshoot_mm = 20}};
    return machine;
}

VirtualOptions by_one_clock(const MachineConfig& machine) { return {.machine = MachineSetup{machine}}; }

struct Measured {
    double most_behind_mm = 0;
    double most_off_mm = 0;
};

class RepeatedProbes : public ProbingRig {
public:
    explicit RepeatedProbes(const VirtualOptions& options) : ProbingRig(options), options_(options) {}
    void TestBody() override {}

    /// Probes from X5 again and again. Each touch comes somewhat later in a frame than the one before.
    Measured measure() {
        Measured all;
        home();
        log.steps.clear();
        for (int k = 0; k < kTableMoves; ++k) {
            EXPECT_EQ(run(probing({.target_mm = {90, 5}, .feed_mm_s = kTableFeed_mm_s})).status, ReplyStatus::Accepted);
            wait(1.5 + 0.0137 * k);
            const Tick pressed = vm.now();
            touch();
            EXPECT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
            const double behind = static_cast<double>(counts()[kX]) / 100 - result().places_mm[kX];
            all.most_behind_mm = std::max(all.most_behind_mm, behind);
            all.most_off_mm = std::max(all.most_off_mm, std::abs(result().places_mm[kX] - place_mm(pressed)));
            touch(false);
            wait(0.1);
            const double here = static_cast<double>(counts()[kX]) / 100;
            EXPECT_EQ(run(program_of({{5, 5}}, 20, {here, 5})).status, ReplyStatus::Accepted);
            EXPECT_TRUE(reaches(MachinePhase::Idle, 5)) << describe();
        }
        return all;
    }

private:
    /// Where the slide of X was, by its steps since the homing.
    double place_mm(Tick at) const {
        std::int64_t count = 500;
        for (const StepLog::Step& step : log.steps) {
            const Tick tick{step.tick};
            const double truth = options_.clocks.empty() ? static_cast<double>(step.tick)
                                                         : options_.clocks[kX].device.truth(tick, options_.start);
            if (step.axis == kX && truth <= static_cast<double>(at.value)) { count += step.direction; }
        }
        return static_cast<double>(count) / 100;
    }

    VirtualOptions options_;
};

std::string row_of(const std::string& name, const ProtocolTiming& timing) {
    const MachineConfig machine = probe_elsewhere(timing);
    const Measured one = RepeatedProbes(by_one_clock(machine)).measure();
    const Measured apart = RepeatedProbes(test::by_clocks_apart(machine)).measure();
    const double announced =
        overshoot_mm(machine, machine.inputs[0], kTableFeed_mm_s, Braking::of_axis(machine, AxisIndex{kX}));
    EXPECT_LE(one.most_behind_mm, announced);
    EXPECT_LE(apart.most_behind_mm, announced);
    return fmt::format("| {} | {:.3f} mm | {:.3f} mm | {:.3f} mm | {:.3f} mm |", name, announced,
                       std::max(one.most_behind_mm, apart.most_behind_mm), one.most_off_mm, apart.most_off_mm);
}

TEST(TouchTable, HasWhatSimulatedMachinesMeasure) {
    const std::vector<std::string> rows{
        row_of("a host that stalls for 100 ms (the examples, the defaults)", {}),
        row_of("the same, and two faults at once", with_least_times({.late_check_slots = 10})),
        row_of("a quiet network", with_least_times({.slot_us = 1000, .stall_slots = 1, .late_check_slots = 0}))};
    std::ifstream document("docs/protocol.md");
    std::vector<std::string> found;
    for (std::string line; std::getline(document, line);) {
        if (std::ranges::find(rows, line) != rows.end()) { found.push_back(line); }
    }
    EXPECT_EQ(found, rows) << "write these rows into docs/protocol.md";
}

}  // namespace
}  // namespace lockstep
