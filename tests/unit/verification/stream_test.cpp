// The record of a program that was sent while it ran: its parts follow the beginning of its job.
#include <gtest/gtest.h>

#include "clients/verification/verification.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

class RecordedStream : public testing::Test {
protected:
    static constexpr std::uint64_t kProgram = 77;
    static std::filesystem::path path() { return test::test_directory() / "stream.lcm"; }

    /// A curve in short chords: how it is joined depends on what follows.
    std::vector<Block> chords(int count) {
        std::vector<Block> blocks;
        for (int k = 0; k < count; ++k, ++line) {
            const double angle = 0.02 * line;
            blocks.push_back({line, LinearMove{{60 + 30 * std::cos(angle) - 30, 60 + 30 * std::sin(angle)}, 60}});
        }
        return blocks;
    }
    void send(test::RecordedMachine& machine, ProgramPart part) {
        part.program = kProgram;
        part.index = index++;
        if (part.index == 0) { part.head = {"stream.gcode", {"X", "Y"}, start}; }
        const std::uint64_t sequence = machine.vm().send(part);
        ASSERT_TRUE(
            machine.vm().advance_until([&] { return machine.vm().reply_to(sequence) != nullptr; }, Ticks{500'000}));
    }
    bool starves(test::RecordedMachine& machine) {
        return machine.vm().advance_until(
            [&] {
                return machine.vm().state()->lacks_blocks &&
                       std::ranges::all_of(machine.vm().axis_states(), [](const auto& axis) { return axis->at_rest; });
            },
            Ticks{20'000'000});
    }
    /// Its parts come late, so that it rests on the path again and again, with other overrides each time.
    void run(bool is_ended = true) {
        const MachineConfig machine = test::example("two-axis");
        start = parked_mm(machine);
        test::RecordedMachine recorded(machine, path());
        recorded.home();
        send(recorded, {.blocks = {{1, LinearMove{{60, 60}, 0, true}}}});
        recorded.command(CommandKind::Run, kProgram);
        for (int part = 1; part < 5; ++part) {
            send(recorded, {.blocks = chords(100 * part)});
            recorded.turn({60 + 10 * part, 100});
            ASSERT_TRUE(starves(recorded)) << part;
        }
        if (!is_ended) { return; }
        send(recorded, {.is_last = true, .blocks = chords(300)});
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        EXPECT_EQ(recorded.vm().state()->outcome, JobOutcome::Done);
        recorded.advance_ms(2000);
    }

    std::vector<double> start;
    std::int32_t line = 2;
    std::uint32_t index = 0;
};

TEST_F(RecordedStream, VerifiesExactlyThoughItStarved) {
    run();
    const auto findings = verify_log(path());
    ASSERT_TRUE(findings) << findings.error();
    EXPECT_TRUE(findings->is_exact()) << to_text(*findings);
    EXPECT_EQ(findings->jobs, 1);
}

TEST_F(RecordedStream, VerifiesAsFarAsItIsKnownWithoutAnEnd) {
    run(false);
    const auto findings = verify_log(path());
    ASSERT_TRUE(findings) << findings.error();
    EXPECT_NE(to_text(*findings).find("its content is what the programs give"), std::string::npos)
        << to_text(*findings);
}

TEST_F(RecordedStream, ReportsAMissingPart) {
    run();
    test::AlteredLog log(path());
    ASSERT_EQ(log.leave_out<program_part_t>("_PROGRAM", [](const program_part_t& part) { return part.part == 2; }), 1U);
    const auto findings = verify_log(log.write(test::test_directory() / "lacks.lcm"));
    ASSERT_TRUE(findings) << findings.error();
    EXPECT_FALSE(findings->is_exact());
    EXPECT_NE(to_text(*findings).find("parts are not in the log"), std::string::npos) << to_text(*findings);
}

}  // namespace
}  // namespace lockstep::verification
