// A device dies, and another replaces it and counts from 0. The runs before and after are verified.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "clients/verification/verification.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

using test::kY;
using test::RecordedMachine;
using testing::Contains;
using testing::HasSubstr;

Findings verified_with_a_device_lost(std::int64_t into_ms) {
    const MachineSetup machine = test::example("two-axis");
    const auto log = test::test_directory() / "run.lcm";
    {
        RecordedMachine recorded(machine, log);
        recorded.home();
        recorded.begin(test::program_of(machine, "G21 G90 F3000\nG1 X80 Y90\nX9 Y70\n"));
        recorded.advance_ms(into_ms);
        recorded.vm().schedule({.kind = VirtualFault::Kind::KillDevice,
                                .process = kY,
                                .at = recorded.vm().now(),
                                .lasts = Ticks{1'000'000}});
        EXPECT_TRUE(recorded.reaches(MachinePhase::Fault));
        recorded.advance_ms(2000);
        recorded.command(CommandKind::Reset);
        recorded.advance_ms(500);
        recorded.home();
        recorded.begin(test::program_of(machine, "G21 G90 F3000\nG1 X20 Y30\n"));
        EXPECT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.advance_ms(500);
    }
    const auto findings = verify_log(log);
    EXPECT_TRUE(findings.has_value()) << findings.error();
    return findings.value_or(Findings{});
}

TEST(LostDevice, RunsBeforeItDiedAndAfterItWasReplacedAreVerified) {
    for (const std::int64_t into_ms : {350, 900, 1500, 1777}) {
        const Findings findings = verified_with_a_device_lost(into_ms);
        EXPECT_FALSE(findings.difference) << into_ms << ": " << to_text(findings);
        EXPECT_EQ(findings.jobs, 2) << into_ms;
        EXPECT_THAT(findings.notes, Contains(HasSubstr("axis Y: its device was lost after"))) << into_ms;
    }
}

}  // namespace
}  // namespace lockstep::verification
