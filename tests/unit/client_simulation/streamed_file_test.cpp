// A file that is simulated while it is read gives the same steps as the whole program, in bounded memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "clients/simulation/simulate.hpp"
#include "services/documents/program_file.hpp"
#include "services/record/sinks.hpp"
#include "services/wire/lcm/lcm_decode.hpp"
#include "tests/temporary_directory.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

constexpr std::uint64_t kBytesOfARow = row_width(3) * sizeof(double);

struct RecordedStep {
    std::int64_t tick = 0;
    int direction = 0;
};

/// Keeps every step by its axis's channel, and a digest of all that is written.
class StepsSink final : public RecordSink {
public:
    void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) override {
        for (const std::uint8_t byte : bytes) { add(byte); }
        add(static_cast<std::uint64_t>(utime));
        if (!channel.ends_with("_STEPS")) { return; }
        const auto batch = decode_lcm<step_batch_t>(bytes);
        std::int64_t tick = batch->first_tick;
        for (std::size_t i = 0; i < static_cast<std::size_t>(batch->count); ++i) {
            tick += batch->delta_ticks[i];
            steps[channel].push_back({tick, batch->direction[i]});
        }
    }

    std::map<std::string, std::vector<RecordedStep>> steps;
    std::uint64_t digest = 0;

private:
    void add(std::uint64_t value) { digest = (digest ^ value) * 0x9e3779b97f4a7c15U; }
};

class StreamedFile : public testing::Test {
protected:
    void write(const std::string& text) const { std::ofstream(file_) << text; }
    ProgramText text() const {
        return {LineReader::open(file_.string()).value(), program_setup(file_, machine_, parked_mm(machine_))};
    }
    SimulationResult streamed(RecordSink& sink, std::uint64_t blocks_kept = 100'000,
                              const SimulationHooks& hooks = {}) const {
        ProgramText program = text();
        return simulate(machine_, program, sink, hooks, blocks_kept * kBytesOfARow).value();
    }
    SimulationResult whole(RecordSink& sink) const {
        return simulate(machine_, load_gcode_file(file_, machine_, parked_mm(machine_)).value(), sink).value();
    }
    void expect_the_steps_of_the_whole(std::uint64_t blocks_kept = 100'000) const {
        StepsSink part_by_part;
        StepsSink at_once;
        const SimulationResult result = streamed(part_by_part, blocks_kept);
        const SimulationResult expected = whole(at_once);
        EXPECT_EQ(result.outcome, JobOutcome::Done) << result.trouble;
        EXPECT_EQ(result.motion, expected.motion);
        EXPECT_EQ(result.final_counts, expected.final_counts);
        EXPECT_EQ(result.steps, expected.steps);
        for (const auto& [channel, steps] : at_once.steps) {
            SCOPED_TRACE(channel);
            expect_same(part_by_part.steps[channel], steps);
        }
    }
    /// Steps of the program may come some slots later, because its first part is still on its way.
    void expect_same(const std::vector<RecordedStep>& steps, const std::vector<RecordedStep>& expected) const {
        ASSERT_EQ(steps.size(), expected.size());
        std::vector<std::int64_t> later;
        for (std::size_t i = 0; i < steps.size(); ++i) {
            ASSERT_EQ(steps[i].direction, expected[i].direction) << i;
            later.push_back(steps[i].tick - expected[i].tick);
        }
        const std::int64_t last = later.back();
        EXPECT_EQ(last % machine_.slot_ticks().value, 0);
        EXPECT_TRUE(std::ranges::is_sorted(later)) << "homing, then the program";
        EXPECT_TRUE(std::ranges::all_of(later, [=](std::int64_t ticks) { return ticks == 0 || ticks == last; }));
    }

    TemporaryDirectory directory_;
    std::filesystem::path file_ = directory_.path() / "long.gcode";
    MachineSetup machine_ = test::example("three-axis");
};

/// Lines of 0.01 mm on a circle.
std::string dense_lines(int lines) {
    std::string text = "G21 G90 F3000\nG0 X60 Y50\n";
    for (int k = 1; k <= lines; ++k) {
        const double angle = 0.001 * k;
        text += "G1 X" + std::to_string(50 + 10 * std::cos(angle)) + " Y" + std::to_string(50 + 10 * std::sin(angle)) +
                "\n";
    }
    return text;
}

TEST_F(StreamedFile, MakesTheStepsOfTheWholeProgram) {
    write(dense_lines(8000) + "M8\nG4 P0.2\nG0 X60 Y50 Z10\nG2 X50 Y40 I-10 J0\nM9\n" + dense_lines(4000));
    expect_the_steps_of_the_whole();
}

TEST_F(StreamedFile, MakesThemWithAsFewBlocksAsThePlannerNeeds) {
    write(dense_lines(20'000));
    expect_the_steps_of_the_whole(6'000);
}

TEST_F(StreamedFile, PassesEveryPause) {
    write("G0 X15\nM0\nM0\n" + dense_lines(3000) + "M0\n" + dense_lines(500) + "G0 X25 Y30\nM0\n");
    expect_the_steps_of_the_whole();
}

TEST_F(StreamedFile, PassesThemWithoutRoomForALeg) {
    write(dense_lines(3000) + "M0\nM0\n" + dense_lines(5000) + "M0\n" + dense_lines(3000));
    NoSink nowhere;
    const SimulationResult result = streamed(nowhere, 2000);
    EXPECT_EQ(result.outcome, JobOutcome::Done) << result.trouble;
    EXPECT_LT(result.most_blocks_kept, 5000U);
}

TEST_F(StreamedFile, WithoutABlockIsDone) {
    write("G21 G90\n(nothing)\n");
    NoSink nowhere;
    EXPECT_EQ(streamed(nowhere).outcome, JobOutcome::Done);
}

TEST_F(StreamedFile, LeavesTheSameRecord) {
    write(dense_lines(6000));
    StepsSink one;
    StepsSink two;
    (void)streamed(one);
    (void)streamed(two);
    EXPECT_EQ(one.digest, two.digest);
}

TEST_F(StreamedFile, OfAnyLengthIsKeptInTheSameMemory) {
    constexpr std::uint64_t kKept = 10'000;
    NoSink nowhere;
    for (const int lines : {20'000, 60'000}) {
        write(dense_lines(lines));
        const SimulationResult result = streamed(nowhere, kKept);
        EXPECT_EQ(result.outcome, JobOutcome::Done) << result.trouble;
        EXPECT_LE(result.most_blocks_kept, kKept);
        EXPECT_GT(result.most_blocks_kept, kKept / 2);
    }
}

/// The 20,000 lines are one straight line. The planner cannot begin before it knows the end of it.
TEST_F(StreamedFile, IsKeptAsFarAsThePlannerMustLookAhead) {
    std::string text = "G21 G90 F3000\n";
    for (int k = 1; k <= 20'000; ++k) { text += "G1 X" + std::to_string(10 + 0.001 * k) + "\n"; }
    write(text);
    NoSink nowhere;
    const SimulationResult result = streamed(nowhere, 3000);
    EXPECT_EQ(result.outcome, JobOutcome::Done) << result.trouble;
    EXPECT_GT(result.most_blocks_kept, 3000U);
}

TEST_F(StreamedFile, ThatBecomesShorterIsRunAsFarAsItGoes) {
    write(dense_lines(60'000));
    NoSink nowhere;
    const auto size = std::filesystem::file_size(file_);
    const SimulationHooks hooks{.progress =
                                    [&](double done) {
                                        if (done > 0.05) { std::filesystem::resize_file(file_, size * 2 / 3); }
                                        return true;
                                    },
                                .stopwatch = {}};
    const SimulationResult result = streamed(nowhere, 4000, hooks);
    EXPECT_NE(result.job, 0U);
    EXPECT_EQ(result.outcome, JobOutcome::Stopped);
    EXPECT_EQ(result.fault, FaultCode::ProgramCutShort);
    EXPECT_THAT(result.trouble, HasSubstr("long.gcode:40"));
    EXPECT_THAT(result.trouble, HasSubstr("shorter"));
    EXPECT_THAT(result.trouble, HasSubstr("the lines before this one were run"));
}

TEST_F(StreamedFile, ThatIsWrongFromItsBeginIsNotRun) {
    write("G0 X10\nG1 Q\n");
    NoSink nowhere;
    const SimulationResult result = streamed(nowhere);
    EXPECT_EQ(result.job, 0U);
    EXPECT_THAT(result.trouble, HasSubstr("long.gcode:2:"));
}

TEST_F(StreamedFile, IsCancelledByTheCaller) {
    write(dense_lines(3000));
    NoSink nowhere;
    ProgramText program = text();
    const SimulationHooks hooks{.progress = [](double done) { return done < 0.1; }, .stopwatch = {}};
    EXPECT_FALSE(simulate(machine_, program, nowhere, hooks).has_value());
}

}  // namespace
}  // namespace lockstep
