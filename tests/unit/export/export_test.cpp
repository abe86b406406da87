// The table of a log has a row for each instant, in rising time, and a column for each signal with its unit in its
// name.
#include "clients/export/export.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <limits>
#include <lockstep/axis_position_t.hpp>
#include <lockstep/channel_event_t.hpp>
#include <lockstep/job_t.hpp>
#include <lockstep/record_mark2_t.hpp>
#include <random>
#include <sstream>

#include "services/wire/lcm/lcm_log.hpp"

namespace lockstep::exporting {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

axis_position_t position(const std::string& axis, std::int64_t utime, double position_mm) {
    axis_position_t message{};
    message.machine = "mill";
    message.axis = axis;
    message.utime = utime;
    message.position_mm = position_mm;
    message.state = "Cruise";
    return message;
}

/// While it lives, no file of this process can become larger, as on a full disk.
class LimitedFileSize {
public:
    explicit LimitedFileSize(rlim_t bytes) {
        (void)::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        (void)::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~LimitedFileSize() {
        (void)::setrlimit(RLIMIT_FSIZE, &before_);
        (void)std::signal(SIGXFSZ, handler_);
    }
    LimitedFileSize(const LimitedFileSize&) = delete;
    LimitedFileSize& operator=(const LimitedFileSize&) = delete;

private:
    void (*handler_)(int) = std::signal(SIGXFSZ, SIG_IGN);  // so that write() returns an error
    rlimit before_{};
};

class Export : public testing::Test {
protected:
    Export() {
        std::filesystem::remove_all(directory);
        std::filesystem::create_directories(directory);
    }

    void write(const std::vector<axis_position_t>& messages) const {
        auto writer = LogWriter::open(log).value();
        for (const auto& message : messages) {
            writer.write_message("LOCKSTEP_MILL_" + message.axis + "_POSITION", message.utime, message);
        }
        ASSERT_TRUE(writer.flush());
    }
    static std::string text_of(const std::filesystem::path& path) {
        std::ostringstream text;
        text << std::ifstream(path, std::ios::binary).rdbuf();
        return text.str();
    }
    /// The lines of the table.
    std::vector<std::string> table(Format format = Format::Csv) {
        const auto result = export_log(log, out, format);
        EXPECT_TRUE(result) << result.error();
        exported = result.value_or(Exported{});
        std::istringstream text(text_of(out));
        std::vector<std::string> lines;
        for (std::string line; std::getline(text, line);) { lines.push_back(line); }
        return lines;
    }

    std::filesystem::path directory = std::filesystem::path(testing::TempDir()) / "lockstep_export" /
                                      testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::path log = directory / "run.lcm";
    std::filesystem::path out = directory / "out";
    Exported exported;
};

TEST_F(Export, HasOneRowForAnInstantAndAColumnForEachSignalOfEachAxis) {
    write({position("X", 5'000'000, 1.5), position("Y", 5'000'000, 2.5), position("X", 5'010'000, 1.75)});
    const auto lines = table();
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_THAT(lines[0], StartsWith("time_s,mill/X/position_mm,mill/X/velocity_mm_s,"));
    EXPECT_THAT(lines[0], HasSubstr(",mill/Y/position_mm,"));
    EXPECT_EQ(lines[1], "0,1.5,0,0,0,0,0,Cruise,0,none,2.5,0,0,0,0,0,Cruise,0,none");
    EXPECT_EQ(lines[2], "0.01,1.75,0,0,0,0,0,Cruise,0,none,,,,,,,,,");
    EXPECT_EQ(exported.samples, 3);
}

TEST_F(Export, RowsRiseInTimeForReorderedMessagesAndLateOnesAreCounted) {
    write({position("X", 1'000'000, 1), position("X", 900'000, 2), position("X", 9'000'000, 3),
           position("X", 950'000, 4)});
    const auto lines = table();
    ASSERT_EQ(lines.size(), 4U);
    EXPECT_THAT(lines[1], StartsWith("0,2,"));
    EXPECT_THAT(lines[2], StartsWith("0.1,1,"));
    EXPECT_THAT(lines[3], StartsWith("8.1,3,"));
    EXPECT_EQ(exported.left_out, 1);
}

TEST_F(Export, NonNumbersLeaveTheirCellEmptyAndTextIsQuotedIfNeeded) {
    auto odd = position("X", 1, std::numeric_limits<double>::quiet_NaN());
    odd.state = "a,\"b\"";
    write({odd});
    EXPECT_EQ(table().at(1), "0,,0,0,0,0,0,\"a,\"\"b\"\"\",0,none");
}

TEST_F(Export, NamesAMotorOfMissingMessages) {
    auto writer = LogWriter::open(log).value();
    job_t job{};
    job.machine = "mill";
    job.event = "begun";
    job.utime = 1'000'000;
    job.config = R"(name: "mill" axis { name: "Y" steps_per_mm: 80 start_velocity_mm_s: 10 max_velocity_mm_s: 150
        max_accel_mm_s2: 1500 position_min_mm: 0 position_max_mm: 100 max_skew_mm: 3
        motor { name: "Y1" } motor { name: "Y2" } })";
    writer.write_message("LOCKSTEP_MILL_JOB", job.utime, job);
    for (const std::int64_t sequence : {0, 1, 4}) {
        auto message = position("Y2", 1'000'000 + sequence, 1);
        message.sequence = sequence;
        writer.write_message("LOCKSTEP_MILL_Y2_POSITION", message.utime, message);
    }
    ASSERT_TRUE(writer.flush());
    (void)table();
    EXPECT_EQ(exported.record.missing, (std::vector<std::string>{"motor Y2: 2 messages of positions"}));
}

TEST_F(Export, ReportsChangesOfOutputsMissingAtTheEnd) {
    auto writer = LogWriter::open(log).value();
    channel_event_t event{};
    event.machine = "mill";
    event.axis = "X";
    event.kind = "digital";
    writer.write_message("LOCKSTEP_MILL_X_CHANNELS", 0, event);
    record_mark2_t mark{};
    mark.utime = 9'000'000;
    mark.machine = "mill";
    mark.witness = mark.process = "X";
    mark.ended = 1;
    mark.channel_events = 3;
    writer.write_message("LOCKSTEP_MILL_X_MARK", mark.utime, mark);
    ASSERT_TRUE(writer.flush());
    (void)table();
    ASSERT_EQ(exported.record.missing.size(), 1U);
    EXPECT_THAT(exported.record.missing[0],
                StartsWith("axis X: 2 messages of changes of inputs and outputs missing at the end"));
}

TEST_F(Export, ReportsMissingMessagesOfTheRecord) {
    std::vector<axis_position_t> messages;
    for (const std::int64_t sequence : {0, 1, 4}) {
        messages.push_back(position("X", 1'000'000 + sequence, 1));
        messages.back().sequence = sequence;
    }
    write(messages);
    (void)table();
    EXPECT_EQ(exported.record.missing, (std::vector<std::string>{"axis X: 2 messages of positions"}));
    EXPECT_THAT(to_text(exported.record), StartsWith("missing: axis X: 2 messages"));
    write({position("X", 1'000'000, 1)});
    (void)table();
    EXPECT_TRUE(exported.record.is_complete());
    EXPECT_THAT(to_text(exported.record), StartsWith("complete as far as is known: ")) << "no mark states how much was";
}

TEST_F(Export, IsNotBegunWithoutDataToExport) {
    write({});
    EXPECT_FALSE(export_log(log, out, Format::Csv));
    EXPECT_FALSE(export_log(log, out, Format::Mcap));
    EXPECT_FALSE(export_log(directory / "none.lcm", out, Format::Csv));
    EXPECT_FALSE(std::filesystem::exists(out)) << "no partial file is left";
}

TEST_F(Export, FullDiskIsAnErrorThatNamesTheFileAndLeavesNoPart) {
    std::vector<axis_position_t> messages;
    for (int i = 0; i < 30'000; ++i) { messages.push_back(position("X", i * 10'000, i)); }
    write(messages);
    const LimitedFileSize full(500'000);
    for (const Format format : {Format::Csv, Format::Mcap}) {
        const auto result = export_log(log, out, format);
        ASSERT_FALSE(result);
        EXPECT_EQ(result.error(), out.string() + ": not written completely: File too large");
    }
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory), {}), 1) << "only the log is left";
}

TEST_F(Export, OfADamagedLogContainsTheReadableSamples) {
    std::vector<axis_position_t> messages;
    for (int i = 0; i < 50; ++i) { messages.push_back(position(i % 2 == 0 ? "X" : "Y", i * 10'000, i)); }
    write(messages);
    const std::string whole = text_of(log);
    std::mt19937_64 random(7);
    for (int round = 0; round < 100; ++round) {
        std::string bytes = whole;
        for (auto left = 1 + random() % 8; left > 0; --left) {
            bytes[random() % bytes.size()] = static_cast<char>(random());
        }
        std::ofstream(log, std::ios::binary) << bytes;
        for (const Format format : {Format::Csv, Format::Mcap}) {
            const auto result = export_log(log, out, format);
            EXPECT_TRUE(result ? result->samples > 0 : !result.error().empty()) << "round " << round;
        }
    }
}

}  // namespace
}  // namespace lockstep::exporting
