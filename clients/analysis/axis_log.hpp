// The content of a log for one axis.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "clients/analysis/csv.hpp"
#include "clients/analysis/measure/axis_statistics.hpp"
#include "clients/analysis/measure/lateness.hpp"
#include "clients/analysis/measure/position_log.hpp"
#include "clients/analysis/measure/tick_histogram.hpp"
#include "clients/analysis/measure/trace.hpp"
#include "services/record/reading/message_numbers.hpp"
#include "services/record/reading/positions/recorded_position.hpp"
#include "services/record/reading/run.hpp"
#include "services/record/reading/step_stream.hpp"

namespace lockstep::analysis {

/// How late an axis's steps were against the commanded ticks, in ticks.
struct LateFigures {
    TickHistogram amounts;
    Course course;

    void add(const EquallyLate& steps, bool keeps_course) {
        amounts.add(steps.late, std::ssize(steps.steps));
        if (!keeps_course) { return; }
        course.add_equal(static_cast<double>(steps.late.value), steps.steps.size(),
                         [&](std::size_t i) { return steps.steps.tick(i); });
    }
};

/// The numbers of an axis's messages without steps, of which some may be missing.
struct SampleNumbers {
    MessageNumbers positions;
    MessageNumbers figures;  // of health messages
    MessageNumbers changes;  // of inputs and outputs
};

class AxisLog {
public:
    static constexpr std::string_view kPositionsHeader = "tick,position_steps,position_mm,velocity_mm_per_s";

    /// `keeps_curves`: the courses over time and the trace are wanted. Passes all steps to `listener` too, which must
    /// live until the end of the log.
    AxisLog(std::string name, bool keeps_curves, MeasuredListener& listener, std::size_t lane)
        : name_(std::move(name)), statistics_(keeps_curves) {
        statistics_.set_listener(listener, lane);
        if (keeps_curves) { stream_.listen(trace_); }
    }
    AxisLog(const AxisLog&) = delete;
    AxisLog& operator=(const AxisLog&) = delete;

    /// Also writes every later step and position to `steps_<axis>.csv` and `positions_<axis>.csv`.
    std::expected<void, std::string> write_csv(const std::filesystem::path& directory);

    void take(StepBatch batch);
    /// The configuration of the machine, from its first job on.
    void set_machine(const MachineConfig& machine) { positions_.set_machine(machine, name_); }
    void take(const RecordedPosition& position);
    void take(LateFigures late) { late_ = std::move(late); }
    void take_slack(Sample slack_ms) { slack_.add(slack_ms); }
    SampleNumbers& numbers() { return numbers_; }
    const SampleNumbers& numbers() const { return numbers_; }
    /// Call once, at the end. Fails if a file was not written completely.
    std::expected<void, std::string> finish();

    const std::string& name() const { return name_; }
    const StreamCounts& counts() const { return stream_.counts(); }
    const AxisStatistics& statistics() const { return statistics_; }
    /// How late its steps were against the commanded ticks: a histogram, and signed over time, in ticks.
    const TickHistogram& late() const { return late_.amounts; }
    std::vector<Sample> late_course() const { return late_.course.samples(); }
    /// The minimum time between a frame's arrival and its start, over time, in ms.
    std::vector<Sample> slack() const { return slack_.samples(); }
    const Trace& trace() const { return trace_; }
    const PositionLog& positions() const { return positions_; }
    /// A frame, a tail or an own move that its device ran.
    void take(const Run& run);
    /// The largest acceleration of their pieces, without sign, in steps per tick^2. Jumps of speed between pieces, up
    /// to the start velocity, are not in it. nullopt without runs.
    std::optional<double> commanded_steps_per_tick2() const { return commanded_acceleration_; }
    /// PositionLog::unrecorded_steps() at the end of its steps.
    std::int64_t unrecorded_steps() const {
        return positions_.unrecorded_steps({stream_.last_tick(), stream_.position_steps()});
    }

private:
    std::string name_;
    AxisStatistics statistics_;
    Trace trace_;
    LateFigures late_;
    Course slack_;
    std::unique_ptr<StepCsv> step_csv_;
    std::unique_ptr<CsvFile> position_csv_;
    SampleNumbers numbers_;
    PositionLog positions_;
    std::optional<double> commanded_acceleration_;
    StepStream stream_{{&statistics_}};
};

/// The minimum number of steps that an axis made and the log lacks.
std::int64_t missing_steps_of(const AxisLog& axis);

}  // namespace lockstep::analysis
