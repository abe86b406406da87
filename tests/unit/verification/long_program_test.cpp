// A program of any length is recorded, in parts, and verifies; a missing part is reported.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "clients/analysis/findings.hpp"
#include "clients/verification/verification.hpp"
#include "core/coordinator/program/program_store.hpp"
#include "services/documents/program_document.hpp"
#include "services/record/job_recorder.hpp"
#include "services/record/queued_sink.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

using test::AlteredLog;
using testing::HasSubstr;

constexpr int kLines = 4000;  // more than a job's message carries

std::string many_lines() {
    std::string text = "G21 G90 F6000\n";
    for (int i = 0; i < kLines; ++i) { text += i % 2 == 0 ? "G1 X10.1 Y10\n" : "G1 X10 Y10\n"; }
    return text;
}

class LongProgram : public testing::Test {
protected:
    LongProgram() {
        test::RecordedMachine recorded(test::example("two-axis"), path());
        recorded.home();
        recorded.begin(test::program_of(recorded.vm().machine(), many_lines()));
        recorded.advance_ms(500);
        recorded.command(CommandKind::Stop);
        EXPECT_TRUE(recorded.reaches(MachinePhase::Idle));
    }
    static std::filesystem::path path() { return test::test_directory() / "long.lcm"; }
};

TEST_F(LongProgram, VerifiesFromItsParts) {
    AlteredLog log(path());
    std::size_t largest = 0;
    int parts = 0;
    for (const AlteredLog::Event& event : log.events()) {
        largest = std::max(largest, event.data.size());
        parts += event.channel.ends_with("_PROGRAM") ? 1 : 0;
    }
    EXPECT_LT(largest, 50'000U);
    EXPECT_GT(parts, 3);
    const auto findings = verify_log(path());
    ASSERT_TRUE(findings) << findings.error();
    EXPECT_TRUE(findings->is_exact()) << to_text(*findings);
    EXPECT_EQ(findings->jobs, 1);
    const auto analyzed = analysis::analyze_log(path());
    ASSERT_TRUE(analyzed) << analyzed.error();
    EXPECT_EQ(analyzed->jobs.back().name, "example.gcode");
    EXPECT_GT(analyzed->jobs.back().move_count, kLines / 2);
}

TEST_F(LongProgram, ReportsMissingParts) {
    AlteredLog log(path());
    ASSERT_EQ(log.leave_out<program_part_t>("_PROGRAM", [](const program_part_t& part) { return part.part == 1; }), 1U);
    const auto findings = verify_log(log.write(test::test_directory() / "lacks.lcm"));
    ASSERT_TRUE(findings) << findings.error();
    EXPECT_FALSE(findings->is_exact());
    EXPECT_THAT(to_text(*findings), HasSubstr("its program is not known: 1 of its "));
    const auto analyzed = analysis::analyze_log(test::test_directory() / "lacks.lcm");
    ASSERT_TRUE(analyzed) << analyzed.error();
    EXPECT_NE(analysis::worst_grade(analysis::findings(*analyzed)), analysis::Grade::Good);
}

class CountedLog final : public RecordSink {
public:
    explicit CountedLog(std::atomic<std::uint32_t>& written) : written_(written) {}
    void write(const std::string&, std::int64_t, std::span<const std::uint8_t>) override { ++written_; }

private:
    std::atomic<std::uint32_t>& written_;
};

TEST(ProgramRecord, FitsASmallQueueAsItArrivesInChunks) {
    constexpr std::size_t kQueue = 100'000;  // the program is ten times as long
    constexpr std::uint32_t kChunks = 32;
    std::atomic<std::uint32_t> written = 0;
    const MachineSetup machine = test::example("two-axis");
    {
        QueuedSink sink(
            std::make_unique<CountedLog>(written), [](RecordSink&, const RecordLoss&) {}, "", kQueue);
        JobRecorder recorder(machine, 7, sink);
        for (std::uint32_t i = 0; i < kChunks; ++i) {
            const std::vector<std::uint8_t> bytes(32'768);
            recorder.record(Tick{i}, ProgramChunk{.program = 5, .index = i, .count = kChunks, .bytes = bytes});
            while (written + 1 < i) { std::this_thread::sleep_for(std::chrono::milliseconds{1}); }
        }
        ProgramStore programs(machine);
        programs.accept(5, {.name = "long", .axes = {}, .start_mm = {}, .blocks = {}});
        recorder.record(
            Tick{100}, JobEvent{.kind = JobEvent::Kind::Begun, .job = 2, .program = programs.find(5), .program_id = 5});
        EXPECT_EQ(recorder.published().program_parts, kChunks + 1);
        EXPECT_EQ(sink.failures(), 0U);
    }
    EXPECT_EQ(written, kChunks + 2U) << "the parts, their head, and the job";
}

}  // namespace
}  // namespace lockstep::verification
