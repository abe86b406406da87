// Changes of inputs and outputs that no log contains are named by merge.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "clients/merge/log_merge.hpp"
#include "clients/merge/report.hpp"
#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/lcm_decode.hpp"

namespace lockstep::merge {
namespace {

using testing::HasSubstr;

class Ignored : public RecordSink {
public:
    void write(const std::string&, std::int64_t, std::span<const std::uint8_t>) override {}
};

class MergedChanges : public testing::Test {
protected:
    ~MergedChanges() override { std::filesystem::remove(log); }

    /// Writes changes of an output of Y with these numbers, a second apart.
    static void write_changes(LogWriter& writer, const std::vector<std::int64_t>& numbers) {
        for (const std::int64_t number : numbers) {
            channel_event_t event{};
            event.utime = number * 1'000'000;
            event.machine = "mill";
            event.axis = "Y";
            event.incarnation = 7;
            event.sequence = number;
            event.kind = "digital";
            writer.write_message(channels_of("mill", "Y").channels, event.utime, event);
        }
    }
    template <typename Mark>
    static Mark last_mark() {
        Mark mark{};
        mark.utime = 9'000'000;
        mark.machine = "mill";
        mark.witness = mark.process = "Y";
        mark.incarnation = 7;
        mark.ended = 1;
        return mark;
    }
    std::string text_of(const std::vector<std::int64_t>& numbers, const auto& mark) {
        auto writer = LogWriter::open(log).value();
        write_changes(writer, numbers);
        writer.write_message(mark_channel("mill", "Y"), mark.utime, mark);
        EXPECT_TRUE(writer.flush());
        merged = merge_logs({.logs = {log}, .progress = {}}, ignored).value();
        return to_text(merged, "out.lcm");
    }

    std::filesystem::path log =
        std::filesystem::temp_directory_path() / ("changes-" + std::to_string(getpid()) + ".lcm");
    Ignored ignored;
    Merged merged;
};

TEST_F(MergedChanges, InNoLogAreNamedWithTheTimesAroundThem) {
    auto mark = last_mark<record_mark2_t>();
    mark.channel_events = 5;
    EXPECT_THAT(text_of({0, 1, 2, 3, 4}, mark), HasSubstr("complete: no message of the record is missing"));
    EXPECT_THAT(text_of({0, 1, 3, 4}, mark),
                HasSubstr("Y missing: 1 change of inputs and outputs, between 1.000 s and 3.000 s of machine time"));
    EXPECT_FALSE(merged.is_complete());
    const auto report = to_report(merged, "out.lcm");
    EXPECT_FALSE(report.complete());
    EXPECT_EQ(report.axes(0).missing_channel_messages(), 1);
    EXPECT_EQ(report.axes(0).missing_changes(0).to_us(), 3'000'000);
}

TEST_F(MergedChanges, MissingAtTheEndAreFoundByTheMark) {
    auto mark = last_mark<record_mark2_t>();
    mark.channel_events = 5;
    EXPECT_THAT(text_of({0, 1, 2}, mark),
                HasSubstr("axis Y: 2 messages of changes of inputs and outputs missing at the end (numbers 3 to 4)"));
    EXPECT_FALSE(merged.is_complete());
}

TEST_F(MergedChanges, MissingAtTheEndCannotBeKnownIfAnEarlierVersionWroteTheMark) {
    EXPECT_THAT(text_of({0, 1, 2}, last_mark<record_mark_t>()),
                HasSubstr("complete as far as is known: no message is known to be missing; for axis Y it is not known "
                          "whether changes of inputs and outputs are missing at the end"));
    EXPECT_TRUE(merged.is_complete());
    EXPECT_FALSE(merged.end.is_closed());
}

}  // namespace
}  // namespace lockstep::merge
