// Several logs that each lack messages are merged to one complete log. Messages missing in all of them are reported.
#include "clients/merge/log_merge.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <functional>

#include "clients/merge/named_logs.hpp"
#include "clients/merge/report.hpp"
#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/lcm_decode.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::merge {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Keeps the times, channels and step numbers of the written messages.
class Kept : public RecordSink {
public:
    void write(const std::string& channel, std::int64_t utime, std::span<const std::uint8_t> bytes) override {
        utimes.push_back(utime);
        channels.push_back(channel);
        if (kind_of(channel) == RecordKind::Steps) {
            sequences[channel].push_back(decode_lcm<step_batch_t>(bytes)->sequence);
        }
    }
    std::vector<std::int64_t> utimes;
    std::vector<std::string> channels;
    std::map<std::string, std::vector<std::int64_t>> sequences;
};

/// Axes X and Y: a message of ten steps every 10 ms, with a position between. Machine time is in us, and so are ticks.
class Merge : public testing::Test {
protected:
    static constexpr const char* kGantry = R"(name: "mill" axis { name: "Y" steps_per_mm: 80 start_velocity_mm_s: 10
        max_velocity_mm_s: 150 max_accel_mm_s2: 1500 position_min_mm: 0 position_max_mm: 100 max_skew_mm: 3
        motor { name: "Y1" } motor { name: "Y2" } })";
    using Wanted = std::function<bool(std::int64_t sequence)>;
    static constexpr std::int64_t kMessages = 300;

    Merge() {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    ~Merge() override { fs::remove_all(folder); }

    static bool all(std::int64_t) { return true; }

    static step_batch_t steps(const std::string& axis, std::int64_t sequence) {
        step_batch_t message{};
        message.utime = (sequence + 1) * 10'000;
        message.machine = "mill";
        message.axis = axis;
        message.incarnation = 7;
        message.sequence = sequence;
        message.position_before = sequence * 10;
        message.first_tick = sequence * 10'000 + 500;
        message.count = 10;
        message.delta_ticks.assign(10, 1000);
        message.delta_ticks[0] = 0;
        message.direction.assign(10, 1);
        return message;
    }
    static void write_steps(LogWriter& log, const std::string& axis, std::int64_t sequence) {
        const step_batch_t message = steps(axis, sequence);
        log.write_message(channels_of("mill", axis).steps, message.utime, message);
    }
    static void write_position(LogWriter& log, const std::string& axis, std::int64_t utime) {
        axis_position_t message{};
        message.utime = message.tick = utime;
        message.machine = "mill";
        message.axis = axis;
        message.sequence = utime / 10'000;
        log.write_message(channels_of("mill", axis).position, message.utime, message);
    }

    fs::path log(const std::string& name, const std::string& axes, const Wanted& wanted,
                 std::int64_t end = kMessages) const {
        auto writer = LogWriter::open(folder / name).value();
        for (std::int64_t sequence = 0; sequence < end; ++sequence) {
            for (const char axis : axes) {
                if (!wanted(sequence)) { continue; }
                write_steps(writer, std::string(1, axis), sequence);
                write_position(writer, std::string(1, axis), (sequence + 1) * 10'000 + 5);
            }
        }
        EXPECT_TRUE(writer.flush());
        return folder / name;
    }

    Merged merge(const std::vector<fs::path>& logs) {
        auto merged = merge_logs({.logs = logs, .progress = {}}, kept);
        EXPECT_TRUE(merged) << merged.error();
        return merged ? std::move(*merged) : Merged{};
    }
    void expect_every_step_in_order() {
        EXPECT_TRUE(std::ranges::is_sorted(kept.utimes));
        for (const auto& [channel, numbers] : kept.sequences) {
            ASSERT_EQ(numbers.size(), static_cast<std::size_t>(kMessages)) << channel;
            for (std::int64_t i = 0; i < kMessages; ++i) { EXPECT_EQ(numbers[static_cast<std::size_t>(i)], i); }
        }
    }

    fs::path folder =
        fs::path(testing::TempDir()) / "lockstep_merge" / testing::UnitTest::GetInstance()->current_test_info()->name();
    Kept kept;
};

TEST_F(Merge, CombinesLogsThatLackDifferentMessages) {
    const Merged merged =
        merge({log("net.lcm", "XY", [](std::int64_t n) { return n % 7 != 3; }),
               log("X.lcm", "X", [](std::int64_t n) { return n % 7 == 3 || n < 100; }), log("Y.lcm", "Y", all)});
    EXPECT_TRUE(merged.is_complete());
    expect_every_step_in_order();
    EXPECT_EQ(kept.channels.size(), 4U * kMessages) << "positions too, each once";
    EXPECT_EQ(merged.messages, 4U * kMessages);
    ASSERT_EQ(merged.axes.size(), 2U);
    EXPECT_EQ(merged.axes[0].steps, 10 * kMessages);
    EXPECT_EQ(merged.differing, 0U);
    EXPECT_EQ(merged.late, 0U);
    std::uint64_t read = 0;
    for (const MergedInput& input : merged.inputs) { read += input.messages; }
    EXPECT_EQ(read, merged.messages + merged.duplicates);
}

TEST_F(Merge, NamesMotorsOnceTheMachineIsKnown) {
    const auto text_with = [&](const std::string& config) {
        auto writer = LogWriter::open(folder / "job.lcm").value();
        job_t job{};
        job.utime = 5'000;
        job.machine = "mill";
        job.event = "begun";
        job.config = config;
        writer.write_message(job_channel("mill"), job.utime, job);
        record_mark2_t mark{};
        mark.machine = "mill";
        mark.process = mark.witness = "Y2";
        mark.utime = 4'000'000;
        mark.incarnation = 7;
        writer.write_message(mark_channel("mill", "Y2"), mark.utime, mark);
        mark.steps = 3;
        mark.utime = 5'000'000;
        writer.write_message(mark_channel("mill", "Y2"), mark.utime, mark);
        EXPECT_TRUE(writer.flush());
        return to_text(merge({folder / "job.lcm"}), "out.lcm");
    };
    EXPECT_THAT(text_with(""), testing::HasSubstr("axis Y2: 3 messages of steps missing at the end"));
    const std::string text = text_with(kGantry);
    EXPECT_THAT(text, testing::HasSubstr("motor Y2: 3 messages of steps missing at the end"));
    EXPECT_THAT(text, testing::HasSubstr("motor                     steps"));
}

TEST_F(Merge, ReportsTheRangeOfStepsInNoLog) {
    const auto wanted = [](std::int64_t n) { return n != 0 && n != 50 && n != 51; };
    const Merged merged = merge({log("a.lcm", "X", wanted), log("b.lcm", "X", wanted)});
    EXPECT_FALSE(merged.is_complete());
    ASSERT_EQ(merged.axes.size(), 1U);
    EXPECT_EQ(merged.axes[0].missing_step_messages, 3);
    const auto& missing = merged.axes[0].missing_steps;
    ASSERT_EQ(missing.size(), 2U);
    EXPECT_FALSE(missing[0].from_step) << "its first steps";
    EXPECT_EQ(missing[0].to_step, 10);
    EXPECT_EQ(missing[1].messages, 2);
    EXPECT_EQ(missing[1].from_step, 500);
    EXPECT_EQ(missing[1].from_tick, Tick{499'500});
    EXPECT_EQ(missing[1].to_step, 520);
    EXPECT_EQ(missing[1].to_tick, Tick{520'500});
    EXPECT_THAT(to_text(merged, "out.lcm"),
                HasSubstr("X missing: 2 messages of steps, from step 500 at tick 499 500 to step 520 at tick 520 500"));
    EXPECT_FALSE(to_report(merged, "out.lcm").complete());
}

TEST_F(Merge, ReportsOtherMessagesInNoLog) {
    auto writer = LogWriter::open(folder / "others.lcm").value();
    for (const std::uint64_t number : {4, 5, 8}) {
        const JobRecord event{.machine = "mill", .coordinator = 3, .sequence = number};
        writer.write_message(job_channel("mill"), 0, to_lcm(event, {}, 1000));
        write_position(writer, "X", static_cast<std::int64_t>(number) * 10'000);
    }
    ASSERT_TRUE(writer.flush());
    const Merged merged = merge({folder / "others.lcm"});
    EXPECT_FALSE(merged.is_complete());
    EXPECT_EQ(merged.axes.at(0).missing_positions, 2) << "between the first and the last: a log may begin late";
    EXPECT_EQ(merged.missing_job_events, 2);
    EXPECT_THAT(to_text(merged, "out.lcm"), HasSubstr("X missing: 2 messages of positions"));
}

TEST_F(Merge, ReportsRunsInNoLog) {
    auto writer = LogWriter::open(folder / "runs.lcm").value();
    for (const std::uint64_t number : {0, 1, 4, 5}) {
        const RunRecord run{.machine = "mill", .axis = "X", .incarnation = 7, .sequence = number};
        writer.write_message(channels_of("mill", "X").run, 0, to_lcm(run, 1000));
    }
    ASSERT_TRUE(writer.flush());
    const Merged merged = merge({folder / "runs.lcm"});
    EXPECT_FALSE(merged.is_complete());
    ASSERT_EQ(merged.axes.at(0).missing_runs.size(), 1U);
    EXPECT_EQ(merged.axes[0].missing_runs[0].numbers, (analysis::Numbers{2, 4}));
}

TEST_F(Merge, EachProcessOfAnAxisCountsFromZero) {
    auto writer = LogWriter::open(folder / "restart.lcm").value();
    for (std::int64_t i = 0; i < 20; ++i) {
        step_batch_t message = steps("X", i);
        message.incarnation = i < 10 ? 7 : 8;
        message.sequence = i % 10;
        writer.write_message(channels_of("mill", "X").steps, message.utime, message);
    }
    ASSERT_TRUE(writer.flush());
    const Merged merged = merge({folder / "restart.lcm"});
    EXPECT_TRUE(merged.is_complete());
    EXPECT_EQ(merged.messages, 20U);
    EXPECT_EQ(merged.axes.at(0).steps, 200);
}

TEST_F(Merge, PutsALogInOrderThatIsNearlyInOrder) {
    auto writer = LogWriter::open(folder / "shuffled.lcm").value();
    for (std::int64_t block = 0; block < kMessages; block += 100) {
        for (std::int64_t i = 99; i >= 0; --i) { write_steps(writer, "X", block + i); }
    }
    ASSERT_TRUE(writer.flush());
    const Merged merged = merge({folder / "shuffled.lcm"});
    expect_every_step_in_order();
    EXPECT_EQ(merged.late, 0U);
}

TEST_F(Merge, KeepsAndCountsMessagesLaterThanTheWindow) {
    auto writer = LogWriter::open(folder / "late.lcm").value();
    for (std::int64_t i = 1; i < 1000; ++i) { write_steps(writer, "X", i); }
    write_steps(writer, "X", 0);
    ASSERT_TRUE(writer.flush());
    const Merged merged = merge({folder / "late.lcm"});
    EXPECT_EQ(merged.messages, 1000U);
    EXPECT_EQ(merged.late, 1U);
}

TEST_F(Merge, ReadsTheRestOfADamagedLogAndNamesTheBytes) {
    const auto damaged = log("a.lcm", "X", all);
    const auto whole = log("b.lcm", "X", all);
    {
        std::fstream file(damaged, std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(1000);
        file << std::string(500, '\x5a');
    }
    fs::resize_file(damaged, fs::file_size(damaged) - 17);
    const Merged merged = merge({damaged, whole});
    EXPECT_TRUE(merged.is_complete());
    expect_every_step_in_order();
    ASSERT_FALSE(merged.inputs[0].damages.empty());
    EXPECT_LE(merged.inputs[0].damages[0].first_byte, 1000U);
    EXPECT_TRUE(merged.inputs[1].damages.empty());
}

TEST_F(Merge, ReportsANumberWithTwoContents) {
    const auto a = log("a.lcm", "X", all);
    auto writer = LogWriter::open(folder / "b.lcm").value();
    step_batch_t other = steps("X", 5);
    other.direction[3] = -1;
    writer.write_message(channels_of("mill", "X").steps, other.utime, other);
    ASSERT_TRUE(writer.flush());
    const Merged merged = merge({a, folder / "b.lcm"});
    EXPECT_EQ(merged.differing, 1U);
    EXPECT_EQ(merged.duplicates, 1U);
    expect_every_step_in_order();
}

TEST_F(Merge, ALogInManyFilesIsOneLog) {
    std::vector<fs::path> files;
    for (std::int64_t part = 0; part < 10; ++part) {
        const auto holds = [part](std::int64_t n) { return n / 30 == part; };
        files.push_back(log("X." + std::to_string(part) + ".lcm", "X", holds));
    }
    std::ranges::reverse(files);
    EXPECT_TRUE(merge(files).is_complete());
    expect_every_step_in_order();
}

TEST_F(Merge, AFileThatIsNotALogIsRefused) {
    std::ofstream(folder / "notes.txt") << "not a log";
    std::ofstream(folder / "empty.lcm").flush();
    const auto refused = [&](const std::vector<fs::path>& logs) { return merge_logs({.logs = logs}, kept).error(); };
    EXPECT_THAT(refused({folder / "notes.txt", folder / "empty.lcm"}), HasSubstr("check that they are LCM logs"));
    EXPECT_THAT(refused({folder / "nothing.lcm"}), HasSubstr("nothing.lcm"));
    EXPECT_TRUE(merge({folder / "empty.lcm", log("a.lcm", "X", all)}).is_complete()) << "of a process that ended early";
}

TEST_F(Merge, OtherChannelsAreKeptFromEachLog) {
    auto writer = LogWriter::open(folder / "foreign.lcm").value();
    write_steps(writer, "X", 0);
    writer.write("CAMERA", 123, std::vector<std::uint8_t>{1, 2, 3});
    write_steps(writer, "X", 1);
    ASSERT_TRUE(writer.flush());
    const Merged merged = merge({folder / "foreign.lcm"});
    EXPECT_EQ(merged.foreign, 1U);
    EXPECT_THAT(kept.channels,
                testing::UnorderedElementsAre("LOCKSTEP_MILL_X_STEPS", "CAMERA", "LOCKSTEP_MILL_X_STEPS"));
}

/// A session's logs: an axis's own and the coordinator's, which refer to each other by marks.
class Sessions : public Merge {
protected:
    void write_mark(LogWriter& log, const std::string& writer, const std::string& process, std::int64_t incarnation) {
        const RecordMark mark{.machine = "mill",
                              .witness = writer,
                              .process = process,
                              .incarnation = static_cast<Identity>(incarnation)};
        log.write_message(mark_channel("mill", process), 0, to_lcm(mark, {}, 1000));
    }
    void write_job(LogWriter& log, std::uint64_t job, std::uint64_t sequence, const char* event, std::int64_t utime) {
        JobRecord record{.machine = "mill", .coordinator = 50, .sequence = sequence, .job = job, .event = event};
        log.write_message(job_channel("mill"), utime, to_lcm(record, Tick{utime}, 1000));
    }
    /// Writes the logs of a session. Its number is the incarnation of its axis's process.
    void write_session(std::int64_t number) {
        const std::string name = std::to_string(number) + ".lcm";
        auto axis = LogWriter::open(folder / ("axis-X." + name)).value();
        write_mark(axis, "X", "X", number);
        write_mark(axis, "X", "", number + 50);
        write_steps(axis, "X", number);
        EXPECT_TRUE(axis.flush());
        auto coordinator = LogWriter::open(folder / ("coordinator." + name)).value();
        write_mark(coordinator, "", "", number + 50);
        EXPECT_TRUE(coordinator.flush());
    }
    ChosenLogs choose(const std::vector<fs::path>& names, bool all = false) {
        return choose_logs(named_logs(names).value(), all).value();
    }
    static std::vector<std::string> names_of(const std::vector<fs::path>& paths) {
        std::vector<std::string> names;
        for (const fs::path& path : paths) { names.push_back(path.filename()); }
        return names;
    }
};

TEST_F(Sessions, TheNewestOfADirectoryIsMerged) {
    for (std::int64_t number = 1; number <= 3; ++number) { write_session(number); }
    const auto now = fs::file_time_type::clock::now();
    for (int number = 1; number <= 3; ++number) {
        for (const char* process : {"axis-X.", "coordinator."}) {
            fs::last_write_time(folder / (process + std::to_string(number) + ".lcm"),
                                now + std::chrono::hours(number % 3));
        }
    }
    const ChosenLogs chosen = choose({folder});
    EXPECT_THAT(names_of(chosen.logs), testing::ElementsAre("axis-X.2.lcm", "coordinator.2.lcm"));
    EXPECT_EQ(chosen.left_out.size(), 4U);
    EXPECT_EQ(chosen.sessions_left_out, 2);
    EXPECT_EQ(choose({folder}, true).logs.size(), 6U);
    Merged merged = merge(chosen.logs);
    merged.chosen = chosen;
    EXPECT_THAT(to_text(merged, "out.lcm"), HasSubstr("left out: 4 logs of 2 other sessions"));
}

TEST_F(Sessions, TheOneOfTheNamedRunIsMergedFromADirectory) {
    for (std::int64_t number = 1; number <= 3; ++number) { write_session(number); }
    auto run = LogWriter::open(folder / "run.of.lcm.logger").value();
    write_mark(run, "X", "X", 1);
    ASSERT_TRUE(run.flush());
    EXPECT_THAT(names_of(choose({folder / "run.of.lcm.logger", folder}).logs),
                testing::ElementsAre("run.of.lcm.logger", "axis-X.1.lcm", "coordinator.1.lcm"));
}

TEST_F(Sessions, LogsWithoutMarksAreAlwaysMerged) {
    write_session(1);
    (void)log("axis-Y.lcm", "Y", all);
    EXPECT_EQ(choose({folder}).logs.size(), 3U);
}

TEST_F(Sessions, AJobInSeveralLogsIsOneWithItsEnd) {
    for (const char* name : {"first.lcm", "second.lcm"}) {
        auto writer = LogWriter::open(folder / name).value();
        write_job(writer, 1, 0, "begun", 1000);
        write_job(writer, 1, 1, "ended", 1500);
        ASSERT_TRUE(writer.flush());
    }
    const ChosenLogs chosen = choose({folder});
    ASSERT_EQ(chosen.jobs.size(), 1U);
    EXPECT_EQ(chosen.jobs.front().ended_us, 1500);
    EXPECT_EQ(span_of_job(chosen.jobs, 1)->until_us, 501'500) << "half a second after its end";
}

TEST_F(Sessions, AJobIsTakenFromTheEndOfTheOneBeforeToTheBeginningOfTheNext) {
    auto writer = LogWriter::open(folder / "jobs.lcm").value();
    std::uint64_t sequence = 0;
    for (std::uint64_t job = 1; job <= 3; ++job) {
        write_job(writer, job, sequence++, "begun", static_cast<std::int64_t>(job) * 1000);
        write_job(writer, job, sequence++, "ended", static_cast<std::int64_t>(job) * 1000 + 500);
    }
    ASSERT_TRUE(writer.flush());
    const ChosenLogs chosen = choose({folder});
    const auto span = span_of_job(chosen.jobs, 2);
    ASSERT_TRUE(span);
    EXPECT_EQ(span->from_us, 1501);
    EXPECT_EQ(span->until_us, 3000);
    EXPECT_FALSE(span_of_job(chosen.jobs, 4));
    const auto merged = merge_logs({.logs = chosen.logs, .span = *span, .progress = {}}, kept).value();
    EXPECT_EQ(merged.messages, 2U);
    EXPECT_TRUE(merged.is_complete()) << "messages outside the span are not missing";
}

/// Events of programs are numbered with the jobs of their coordinator.
class EventsOfJobs : public Sessions {
protected:
    Merged merge(const std::vector<std::uint64_t>& left_out) {
        auto writer = LogWriter::open(folder / "events.lcm").value();
        const auto is_there = [&](std::uint64_t number) {
            return std::ranges::find(left_out, number) == left_out.end();
        };
        if (is_there(0)) { write_job(writer, 1, 0, "begun", 1000); }
        for (std::uint64_t number = 1; number < 4; ++number) {
            if (!is_there(number)) { continue; }
            const auto utime = static_cast<std::int64_t>(1000 + 100 * number);
            const EventRecord record{.machine = "mill", .number = {50, number}, .event = {.job = 1}};
            for (int twice = 0; twice < 2; ++twice) {
                writer.write_message(event_channel("mill"), utime, to_lcm(record, {utime}, 1000));
            }
        }
        if (is_there(4)) { write_job(writer, 1, 4, "ended", 2000); }
        EXPECT_TRUE(writer.flush());
        return merge_logs({.logs = choose({folder}).logs, .progress = {}}, kept).value();
    }
};

TEST_F(Merge, NamesTheDirectoryThatTheUserMayNotRead) {
    if (geteuid() != 0) { GTEST_SKIP() << "only root can act as another user"; }
    fs::permissions(folder, fs::perms::owner_all);
    ASSERT_EQ(seteuid(65534), 0);
    const auto logs = named_logs({folder});
    ASSERT_EQ(seteuid(0), 0);
    ASSERT_FALSE(logs);
    EXPECT_EQ(logs.error(), folder.string() + ": this user may not read it; only its owner root may");
}

TEST_F(EventsOfJobs, AreMergedOnceEach) {
    const Merged merged = merge({});
    EXPECT_EQ(kept.utimes, (std::vector<std::int64_t>{1000, 1100, 1200, 1300, 2000}));
    EXPECT_EQ(merged.duplicates, 3U);
    EXPECT_TRUE(merged.is_complete());
}

TEST_F(EventsOfJobs, AreMissingWhereTheirNumbersHaveAGap) {
    EXPECT_EQ(merge({2}).missing_job_events, 1);
    EXPECT_EQ(merge({1, 2, 3}).missing_job_events, 3);
}

/// A program that is recorded in parts before job 1, and run by jobs 1 and 2.
class JobInParts : public Sessions {
protected:
    void write_part(LogWriter& log, std::int64_t sequence, std::int64_t job, std::int32_t part, std::int64_t utime) {
        program_part_t message{};
        message.utime = utime;
        message.machine = "mill";
        message.coordinator = 50;
        message.sequence = sequence;
        message.program = 9;
        message.job = job;
        message.part = part;
        message.parts = job == 0 ? 3 : 0;
        if (job == 0) { message.data.assign(20, static_cast<std::uint8_t>(part)); }
        message.size = static_cast<std::int32_t>(message.data.size());
        log.write_message(program_channel("mill"), utime, message);
    }
    Merged merge_job_2(std::int32_t parts_there) {
        auto writer = LogWriter::open(folder / "parts.lcm").value();
        for (std::int32_t part = 0; part < parts_there; ++part) { write_part(writer, part, 0, part, 100 + part); }
        for (std::int64_t job = 1; job <= 2; ++job) {
            const auto number = static_cast<std::uint64_t>(job);
            write_part(writer, 2 + job, job, 0, job * 1000 - 1);
            write_job(writer, number, 2 * number - 2, "begun", job * 1000);
            write_job(writer, number, 2 * number - 1, "ended", job * 1000 + 500);
        }
        EXPECT_TRUE(writer.flush());
        const ChosenLogs chosen = choose({folder});
        const auto span = span_of_job(chosen.jobs, 2);
        EXPECT_TRUE(span && span->program);
        return merge_logs({.logs = chosen.logs, .span = *span, .progress = {}}, kept).value();
    }
};

TEST_F(JobInParts, IsMergedWithAllPartsOfItsProgramThoughTheyWereRecordedEarlier) {
    const Merged merged = merge_job_2(3);
    EXPECT_EQ(kept.utimes, (std::vector<std::int64_t>{100, 101, 102, 1999, 2000, 2500}));
    EXPECT_TRUE(merged.is_complete());
}

TEST_F(JobInParts, ReportsThePartsThatAreInNoLog) {
    const Merged merged = merge_job_2(2);
    EXPECT_EQ(merged.missing_program_parts, 1);
    EXPECT_FALSE(merged.is_complete());
}

}  // namespace
}  // namespace lockstep::merge
