// On a network that loses, delays, reorders and repeats messages, with holds, stops and resumptions at any time, the
// run is still what the programs give: late frames interrupt an epoch and the next continues from there.
#include <gtest/gtest.h>

#include <random>

#include "clients/verification/verification.hpp"
#include "core/coordinator/path/lai_path.hpp"
#include "tests/random_seeds.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

constexpr std::string_view kTour =
    "G21 G90 F6000\nG1 X60 Y8\nX62 Y50\nX40 Y55\nG4 P0.1\nG0 X10 Y40\nM0\nG0 X80 Y90\nX5 Y5\n";

class Storm : public testing::TestWithParam<std::uint64_t> {
protected:
    /// Some time passes; then a person holds, stops or resumes.
    void interfere(test::RecordedMachine& recorded) {
        recorded.advance_ms(static_cast<std::int64_t>(random() % 1500));
        const auto phase = recorded.vm().state()->phase;
        const bool waits = phase == MachinePhase::Paused || phase == MachinePhase::Holding;
        const bool stops = random() % 12 == 0;
        recorded.command(waits ? CommandKind::Resume : stops ? CommandKind::Stop : CommandKind::Hold);
    }
    bool is_over(test::RecordedMachine& recorded) {
        const auto phase = recorded.vm().state()->phase;
        return phase == MachinePhase::Idle || phase == MachinePhase::Fault;
    }

    void expect_exact(const MachineSetup& machine);

    std::mt19937_64 random{GetParam()};
};

void Storm::expect_exact(const MachineSetup& machine) {
    const auto log = test::test_directory() / ("storm" + std::to_string(GetParam()) + ".lcm");
    const NetworkBehaviour rough{.delay_min = Ticks{50},
                                 .delay_max = Ticks{static_cast<std::int64_t>(random() % 60'000)} + Ticks{50},
                                 .duplicated = 0.05,
                                 .lost = static_cast<double>(random() % 100) * 1e-3};
    {
        test::RecordedMachine recorded(
            {.machine = machine, .config_hash = config_hash(machine), .seed = GetParam(), .network = rough}, log);
        recorded.home();
        recorded.begin(test::program_of(machine, kTour));
        for (int i = 0; i < 20 && !is_over(recorded); ++i) { interfere(recorded); }
        recorded.command(CommandKind::Stop);
        recorded.advance_ms(2000);
        for (const auto& axis : recorded.vm().axis_states()) { EXPECT_EQ(axis->refused_frames, 0U); }
    }
    const auto findings = verify_log(log);
    ASSERT_TRUE(findings.has_value()) << findings.error();
    EXPECT_FALSE(findings->difference) << to_text(*findings);
}

TEST_P(Storm, StillExact) { expect_exact(test::example("two-axis")); }

TEST_P(Storm, StillExactWithLaisPlanner) {
    MachineSetup machine = test::example("two-axis");
    machine.coordination = StepMethod::Lai;
    ASSERT_TRUE(suits_lai_path(machine).has_value());
    expect_exact(machine);
}
INSTANTIATE_TEST_SUITE_P(Seeds, Storm, seeds_from(1, 40));

}  // namespace
}  // namespace lockstep::verification
