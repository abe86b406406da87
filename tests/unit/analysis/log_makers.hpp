// Logs like those of a machine, for the tests here.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <lockstep/step_batch_t.hpp>
#include <string>
#include <vector>

#include "core/program.hpp"
#include "core/step/segment.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/program_document.hpp"
#include "services/setup/machine_setup.hpp"
#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/lcm_log.hpp"
#include "services/wire/lcm/translate_lcm.hpp"
#include "tests/unit/analysis/step_makers.hpp"

namespace lockstep::test {

/// A directory for one test.
inline std::filesystem::path test_directory() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    const auto path =
        std::filesystem::path(testing::TempDir()) / "lockstep_analysis" / info->test_suite_name() / info->name();
    std::filesystem::remove_all(path);
    std::filesystem::create_directories(path);
    return path;
}

/// Two axes of 100 steps per mm.
inline MachineSetup two_axes() {
    const std::string axis =
        "steps_per_mm: 100 start_velocity_mm_s: 5 max_velocity_mm_s: 100 max_accel_mm_s2: 1000 "
        "position_min_mm: 0 position_max_mm: 200";
    return parse_machine("name: \"mill\" axis { name: \"X\" " + axis + " } axis { name: \"Y\" " + axis + " }").value();
}

class LogMaker {
public:
    explicit LogMaker(const std::filesystem::path& path, MachineSetup machine = two_axes())
        : writer_(LogWriter::open(path).value()), machine_(std::move(machine)) {}
    ~LogMaker() { EXPECT_TRUE(writer_.flush()); }

    void steps(const std::string& axis, std::int64_t sequence, std::int64_t before,
               const std::vector<StepEdge>& steps) {
        step_batch_t message{};
        message.machine = "mill";
        message.axis = axis;
        message.incarnation = 7;
        message.sequence = sequence;
        message.position_before = before;
        message.count = static_cast<std::int32_t>(steps.size());
        message.first_tick = steps.empty() ? 0 : steps.front().tick.value;
        Tick last{message.first_tick};
        for (const StepEdge& step : steps) {
            message.delta_ticks.push_back(static_cast<std::int32_t>((step.tick - last).value));
            message.direction.push_back(step.direction);
            last = step.tick;
        }
        writer_.write_message(channels_of("mill", axis).steps, last.value, message);
    }

    void position(std::uint32_t axis, std::int64_t tick, std::int64_t steps) {
        AxisState state;
        state.axis = axis;
        state.tick = Tick{tick};
        state.position = Position::steps(steps);
        writer_.write_message(channels_of("mill", machine_.axes[axis].name).position, tick,
                              to_lcm(machine_, state, {7, positions_[axis]++}));
    }

    /// The log lacks the axis's next message of its position.
    void leave_out_position(std::uint32_t axis) { ++positions_[axis]; }

    void job(const std::string& event, std::int64_t tick, const Program& program, std::string outcome = "",
             std::string kind = "run") {
        JobRecord record{.machine = "mill",
                         .sequence = job_events_++,
                         .job = 3,
                         .kind = std::move(kind),
                         .event = event,
                         .outcome = std::move(outcome)};
        record.start = Tick{tick};
        record.config = machine_text(machine_);
        record.program = program_text(program);
        writer_.write_message(job_channel("mill"), tick, to_lcm(record, Tick{tick}, 1000));
    }

    /// Writes an event of job 3, unless the event names another job.
    void event(PublishedEvent event) {
        if (event.job == 0) { event.job = 3; }
        const EventRecord record{.machine = "mill", .number = {.sequence = job_events_++}, .event = event};
        writer_.write_message(event_channel("mill"), event.tick.value, to_lcm(record, event.tick, 1000));
    }

    /// Writes the change of a channel of an axis's device with this number.
    void channel(const std::string& axis, std::int64_t number, const ChannelEvent& event) {
        channel_event_t message{};
        message.machine = "mill";
        message.axis = axis;
        to_lcm(ChannelRecord{.number = {7, static_cast<std::uint64_t>(number)}, .event = event}, machine_.tick_ns,
               message);
        writer_.write_message(channels_of("mill", axis).channels, event.tick.value, message);
    }

    /// Skips the numbers of the next `count` positions of each axis and job events: the log lacks them.
    void lose(std::uint64_t count) {
        for (std::uint64_t& positions : positions_) { positions += count; }
        job_events_ += count;
    }

    void foreign(const std::string& channel) { writer_.write(channel, 0, std::vector<std::uint8_t>{1, 2, 3}); }

private:
    LogWriter writer_;
    MachineSetup machine_;
    std::array<std::uint64_t, 2> positions_{};  // numbers of positions used so far, by axis
    std::uint64_t job_events_ = 0;
};

/// A program of straight moves through places in the plane.
inline Program path_through(std::vector<std::vector<double>> places) {
    Program program{.name = "square", .axes = {"X", "Y"}, .start_mm = places.front(), .blocks = {}};
    for (std::size_t i = 1; i < places.size(); ++i) {
        program.blocks.push_back({static_cast<std::int32_t>(i), ProgramMove{places[i], 50, false}});
    }
    return program;
}

}  // namespace lockstep::test
