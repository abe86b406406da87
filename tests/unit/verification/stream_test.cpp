// The record of a program that was sent while it ran: its parts follow the beginning of its job.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "clients/verification/verification.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

class RecordedStream : public testing::Test {
protected:
    static constexpr std::uint64_t kProgram = 77;
    static std::filesystem::path path() { return test::test_directory() / "stream.lcm"; }

    /// A curve in short chords. Each chord is joined according to the ones that follow.
    std::vector<Block> chords(int count) {
        std::vector<Block> blocks;
        for (int k = 0; k < count; ++k, ++line) {
            const double angle = 0.02 * line;
            blocks.push_back({line, ProgramMove{{60 + 30 * std::cos(angle) - 30, 60 + 30 * std::sin(angle)}, 60}});
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
    /// The program's parts come late. The machine rests on the path again and again, with other overrides each time.
    void run(bool is_ended = true) {
        const MachineSetup machine = test::example("two-axis");
        start = parked_mm(machine);
        test::RecordedMachine recorded(machine, path());
        recorded.home();
        send(recorded, {.blocks = {{1, ProgramMove{{60, 60}, 0, true}}}});
        recorded.command(CommandKind::Run, kProgram);
        for (int part = 1; part < 5; ++part) {
            send(recorded, {.blocks = chords(100 * part)});
            recorded.set_overrides({60 + 10 * part, 100});
            ASSERT_TRUE(starves(recorded)) << part;
        }
        if (!is_ended) { return; }
        send(recorded, {.is_last = true, .blocks = chords(300)});
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        EXPECT_EQ(recorded.vm().state()->outcome, JobOutcome::Done);
        recorded.advance_ms(2000);
    }

    /// Short lines and arcs in chords, with corners and other feeds between them.
    std::vector<Block> lines(int count, std::mt19937_64& random) {
        std::uniform_real_distribution<> share(0, 1);
        std::vector<Block> blocks;
        for (int k = 0; k < count; ++k, ++line) {
            if (random() % 20 == 0) { turn_by = 0.2 * (share(random) - 0.5); }
            if (random() % 50 == 0) { heading += 3 * share(random); }
            if (random() % 40 == 0) { feed = 10 + 90 * share(random); }
            if (random() % 30 == 0) { chord = std::pow(10, 1.5 * share(random) - 1); }
            heading += turn_by;
            for (std::size_t i = 0; i < 2; ++i) {
                const double step = chord * (i == 0 ? std::cos(heading) : std::sin(heading));
                at[i] += at[i] + step > 100 || at[i] + step < 10 ? -step : step;
            }
            blocks.push_back({line, ProgramMove{{at[0], at[1]}, feed}});
        }
        return blocks;
    }
    /// Parts come at any time, mostly early enough. Overrides are turned meanwhile.
    void run_with_turns(std::uint64_t seed) {
        std::mt19937_64 random(seed);
        const MachineSetup machine = test::example("two-axis");
        start = parked_mm(machine);
        test::RecordedMachine recorded(machine, path());
        recorded.home();
        send(recorded, {.blocks = {{1, ProgramMove{{60, 60}, 0, true}}}});
        recorded.command(CommandKind::Run, kProgram);
        for (int part = 0; part < 40; ++part) {
            send(recorded, {.blocks = lines(10 + static_cast<int>(random() % 120), random)});
            for (std::uint64_t turns = random() % 4; turns > 0; --turns) {
                recorded.set_overrides({50 + static_cast<int>(random() % 11) * 10, 100});
                if (random() % 2 == 0) { recorded.advance_ms(static_cast<std::int64_t>(random() % 100)); }
            }
            recorded.advance_ms(static_cast<std::int64_t>(random() % 400));
        }
        send(recorded, {.is_last = true, .blocks = lines(30, random)});
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        EXPECT_EQ(recorded.vm().state()->outcome, JobOutcome::Done);
        recorded.advance_ms(2000);
    }

    double heading = 0;
    double turn_by = 0;
    double feed = 50;
    double chord = 0.3;
    std::array<double, 2> at{60, 60};
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

class RecordedStreamTurned : public RecordedStream, public testing::WithParamInterface<std::uint64_t> {};

TEST_P(RecordedStreamTurned, VerifiesExactly) {
    run_with_turns(GetParam());
    const auto findings = verify_log(path());
    ASSERT_TRUE(findings) << findings.error();
    EXPECT_TRUE(findings->is_exact()) << to_text(*findings);
}
INSTANTIATE_TEST_SUITE_P(Seeds, RecordedStreamTurned, testing::Range<std::uint64_t>(1, 9));

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
