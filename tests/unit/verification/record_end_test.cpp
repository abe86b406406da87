// If the end of a record is lost in any way, merge, verify and analyze each report that, or report that the end is
// unknown.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <map>

#include "clients/analysis/analysis_text.hpp"
#include "clients/analysis/findings.hpp"
#include "clients/merge/log_merge.hpp"
#include "clients/merge/report.hpp"
#include "clients/verification/verification.hpp"
#include "tests/unit/verification/altered_log.hpp"
#include "tests/unit/verification/recorded_machine.hpp"

namespace lockstep::verification {
namespace {

namespace fs = std::filesystem;
using test::AlteredLog;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A machine that is homed, runs two programs, rests, and ends on request; each process keeps its own log.
class RecordEnd : public testing::Test {
protected:
    static void SetUpTestSuite() {
        const std::string name = "lockstep_end_" + std::to_string(getpid()) + ".lcm";  // tests run side by side
        original = fs::path(testing::TempDir()) / name;
        test::RecordedMachine recorded(test::example("two-axis"), original);
        recorded.home();
        const MachineSetup& machine = recorded.vm().machine();
        recorded.begin(test::program_of(machine, "G90 F3000\nG1 X70\nX5 Y5\n\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.advance_ms(1500);
        recorded.begin(test::program_of(machine, "G21 G90 F3000\nG1 X20 Y30\n"));
        ASSERT_TRUE(recorded.reaches(MachinePhase::Idle));
        recorded.advance_ms(1500);
    }
    static void TearDownTestSuite() { fs::remove(original); }

    /// The logs by the process that writes them: an axis's name, empty for the coordinator.
    static std::map<std::string, AlteredLog> own_logs() {
        const AlteredLog whole(original);
        std::map<std::string, AlteredLog> logs{{"", whole}, {"X", whole}, {"Y", whole}};
        for (auto& [process, log] : logs) {
            std::erase_if(log.events(), [&](const AlteredLog::Event& event) { return writer_of(event) != process; });
        }
        return logs;
    }
    static std::string writer_of(const AlteredLog::Event& event) {
        if (event.channel.ends_with("_MARK")) { return decode_lcm<record_mark2_t>(event.data).value().witness; }
        for (const std::string axis : {"X", "Y"}) {
            if (event.channel.find("_" + axis + "_") != std::string::npos) { return axis; }
        }
        return "";
    }

    /// Merges them, and verifies and analyzes the result.
    void look_at(const std::map<std::string, AlteredLog>& logs) {
        merge::MergeOptions options;
        for (const auto& [process, log] : logs) {
            options.logs.push_back(log.write(test::test_directory() / ("own-" + process + ".lcm")));
        }
        look_at(options);
    }
    void look_at(const AlteredLog& log) {
        look_at({.logs = {log.write(test::test_directory() / "received.lcm")}, .progress = {}});
    }
    void look_at(const merge::MergeOptions& options) {
        const fs::path whole = test::test_directory() / "whole.lcm";
        LogSink sink(LogWriter::open(whole).value());
        merged = merge::merge_logs(options, sink).value();
        ASSERT_TRUE(sink.finish());
        findings = verify_log(whole).value();
        analyzed = analysis::analyze_log(whole).value();
        texts = {merge::to_text(merged, whole), to_text(findings), analysis::summary(analyzed)};
    }
    void expect_missing(const std::string& what) {
        EXPECT_FALSE(merged.is_complete());
        EXPECT_FALSE(findings.is_exact());
        EXPECT_NE(analysis::worst_grade(analysis::findings(analyzed)), analysis::Grade::Good);
        for (const std::string& text : texts) {
            EXPECT_THAT(text, HasSubstr(what));
            EXPECT_THAT(text, Not(HasSubstr("complete: no message")));
            EXPECT_THAT(text, Not(HasSubstr("nothing missing")));
        }
        EXPECT_THAT(texts[1], testing::StartsWith("unknown: "));
    }
    void expect_open(const std::string& what) {
        EXPECT_TRUE(merged.is_complete());
        EXPECT_FALSE(findings.difference) << texts[1];
        for (const std::string& text : texts) {
            EXPECT_THAT(text, HasSubstr(what));
            EXPECT_THAT(text, Not(HasSubstr("complete: no message")));
            EXPECT_THAT(text, Not(HasSubstr("no step is missing")));
        }
    }
    static std::int64_t begin_of_job(std::int64_t number) {
        std::int64_t utime = 0;
        AlteredLog(original).change<job_t>("_JOB", [&](const job_t& job) {
            if (job.job == number && job.event == "begun") { utime = job.utime; }
            return false;
        });
        return utime;
    }
    /// The log of a writer that was killed, cut off from power, or found its disk full.
    static void cut(AlteredLog& log, std::int64_t utime) {
        std::erase_if(log.events(), [&](const AlteredLog::Event& event) { return event.utime >= utime; });
    }

    static inline fs::path original;
    merge::Merged merged;
    Findings findings;
    analysis::Analysis analyzed;
    std::array<std::string, 3> texts;
};

TEST_F(RecordEnd, IsPresentIfEveryProcessEndedAndEveryLogIsGiven) {
    look_at(own_logs());
    EXPECT_TRUE(merged.is_complete());
    EXPECT_TRUE(merged.end.is_closed());
    EXPECT_THAT(texts[0], HasSubstr("complete: no message of the record is missing"));
    EXPECT_THAT(texts[1], HasSubstr("and 2 jobs are what the programs give"));
    EXPECT_THAT(texts[2], HasSubstr("nothing missing"));
    EXPECT_THAT(texts[2], HasSubstr("no step is missing"));
}

TEST_F(RecordEnd, LogOfAnAxisThatStopsEarlyIsFoundByTheCoordinatorsLog) {
    auto logs = own_logs();
    cut(logs.at("X"), begin_of_job(3));
    look_at(logs);
    expect_missing("of steps missing at the end");
    EXPECT_THAT(texts[0], HasSubstr("axis X: "));
    EXPECT_THAT(texts[0], Not(HasSubstr("axis Y: ")));
}

TEST_F(RecordEnd, LogOfAnAxisThatIsNotGivenIsFound) {
    auto logs = own_logs();
    logs.erase("Y");
    look_at(logs);
    expect_missing("axis Y: ");
    EXPECT_THAT(texts[0], HasSubstr("(numbers 0 to "));
}

TEST_F(RecordEnd, JobsMissingAtTheEndAreFoundByTheAxesLogs) {
    auto logs = own_logs();
    cut(logs.at(""), begin_of_job(2));
    look_at(logs);
    expect_missing("coordinator: 6 messages of jobs missing at the end (numbers 2 to 7)");
}

TEST_F(RecordEnd, LogOfTheCoordinatorThatIsNotGivenIsFound) {
    auto logs = own_logs();
    logs.erase("");
    look_at(logs);
    expect_missing("coordinator: 8 messages of jobs missing at the end (numbers 0 to 7)");
}

TEST_F(RecordEnd, LastMessagesThatALoggerDroppedAreFound) {
    AlteredLog received(original);
    std::int64_t last = 0;
    received.change<step_batch_t>("_X_STEPS", [&](const step_batch_t& batch) {
        last = std::max(last, batch.sequence);
        return false;
    });
    ASSERT_EQ(received.leave_out<step_batch_t>("_X_STEPS", [&](const auto& batch) { return batch.sequence == last; }),
              1U);
    look_at(received);
    expect_missing("axis X: 1 message of steps missing at the end (numbers " + std::to_string(last) + " to " +
                   std::to_string(last) + ")");
}

TEST_F(RecordEnd, ReportsUpToWhenTheRecordIsCompleteIfAllLogsEndAtOnce) {
    auto logs = own_logs();
    for (auto& [process, log] : logs) { cut(log, begin_of_job(3)); }
    look_at(logs);
    expect_open("the record is known to be complete up to machine time ");
    EXPECT_THAT(texts[0], HasSubstr("the end of coordinator, axis X, axis Y is not recorded"));
}

TEST_F(RecordEnd, OfALogWithoutMarksCannotBeKnown) {
    AlteredLog old(original);
    std::erase_if(old.events(), [](const AlteredLog::Event& event) { return event.channel.ends_with("_MARK"); });
    look_at(old);
    expect_open("for coordinator, axis X, axis Y it is not known whether the end is missing");
}

TEST_F(RecordEnd, ALossRecordedAtALogsEndIsFound) {
    const auto marked_last = [](const AlteredLog::Event& event, const std::string& process) {
        return event.channel.ends_with("_MARK") && decode_lcm<record_mark2_t>(event.data).value().process == process;
    };
    auto logs = own_logs();
    for (auto& [process, log] : logs) {  // all disks are full: each log has room only for its own last mark
        const auto own = std::find_if(log.events().rbegin(), log.events().rend(),
                                      [&](const auto& event) { return marked_last(event, process); });
        const AlteredLog::Event last = *own;
        cut(log, begin_of_job(2));
        log.events().push_back(last);
    }
    look_at(logs);
    expect_missing("coordinator: 6 messages of jobs missing at the end (numbers 2 to 7)");
    EXPECT_THAT(texts[0], HasSubstr("axis X: "));
    EXPECT_THAT(texts[0], HasSubstr("axis Y: "));
}

TEST_F(RecordEnd, OfAKilledProcessIsFoundFromTheCoordinatorsMarks) {
    const fs::path log = test::test_directory() / "killed.lcm";
    {
        test::RecordedMachine recorded(test::example("two-axis"), log);
        recorded.home();
        recorded.advance_ms(1500);
        recorded.vm().schedule({.kind = VirtualFault::Kind::Crash, .process = 0, .at = recorded.vm().now()});
        recorded.advance_ms(500);
    }
    AlteredLog killed(log);
    look_at(killed);
    expect_open("the end of axis X is not recorded");
    std::int64_t last = 0;
    killed.change<run_t>("_X_RUN", [&](const run_t& run) {
        last = std::max(last, run.sequence);
        return false;
    });
    killed.leave_out<run_t>("_X_RUN", [&](const run_t& run) { return run.sequence == last; });  // it was not written
    look_at(killed);
    EXPECT_FALSE(merged.is_complete());
    EXPECT_FALSE(findings.is_exact());
    EXPECT_THAT(texts[0], HasSubstr("axis X: 1 message of runs missing at the end"));
}

}  // namespace
}  // namespace lockstep::verification
