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
#include "clients/analysis/measure/tick_histogram.hpp"
#include "clients/analysis/measure/trace.hpp"
#include "services/record/reading/message_numbers.hpp"
#include "services/record/reading/run.hpp"
#include "services/record/reading/step_stream.hpp"

namespace lockstep::analysis {

/// One axis's position message.
struct PositionSample {
    Tick tick;
    std::int64_t position_steps = 0;
    double position_mm = 0;
    double velocity_mm_per_s = 0;
    std::int64_t incarnation = 0;  // of the axis's process
    bool is_homed = false;
    std::int64_t following_error_steps = 0;
};

/// How late an axis's steps were against the commanded ticks, in ticks.
struct LateFigures {
    TickHistogram amounts;
    Course course;

    void add(const EquallyLate& steps, bool keeps_course) {
        amounts.add(steps.late, std::ssize(steps.steps));
        if (!keeps_course) { return; }
        course.add_equal(static_cast<double>(steps.late.value), steps.steps.size(),
                         [&](std::size_t i) { return steps.steps[i].tick; });
    }
};

class AxisLog {
public:
    static constexpr std::string_view kPositionsHeader = "tick,position_steps,position_mm,velocity_mm_per_s";

    /// `keeps_curves`: the courses over time and the trace are wanted.
    AxisLog(std::string name, bool keeps_curves) : name_(std::move(name)), statistics_(keeps_curves) {
        if (keeps_curves) { stream_.listen(trace_); }
    }
    AxisLog(const AxisLog&) = delete;
    AxisLog& operator=(const AxisLog&) = delete;

    /// Also writes every later step and position to `steps_<axis>.csv` and `positions_<axis>.csv`.
    std::expected<void, std::string> write_csv(const std::filesystem::path& directory);

    /// Passes later steps to `listener` too, which must live until the end of the log.
    void set_listener(MeasuredListener& listener, std::size_t lane) { statistics_.set_listener(listener, lane); }
    void take(StepBatch batch);
    void take(const PositionSample& sample);
    void take(LateFigures late) { late_ = std::move(late); }
    void take_slack(Sample slack_ms) { slack_.add(slack_ms); }
    MessageNumbers& position_numbers() { return position_numbers_; }
    MessageNumbers& figure_numbers() { return figure_numbers_; }
    MessageNumbers& change_numbers() { return change_numbers_; }
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
    std::int64_t positions() const { return positions_; }
    /// A frame, a tail or an own move that its device ran.
    void take(const Run& run);
    /// The largest acceleration of their pieces, without sign, in steps per tick^2. Jumps of speed between pieces, up
    /// to the start velocity, are not in it. nullopt without runs.
    std::optional<double> commanded_steps_per_tick2() const { return commanded_acceleration_; }
    /// Without its sign.
    std::int64_t largest_following_error() const { return following_error_; }
    /// Missing messages between the first and the last in the log.
    std::int64_t missing_positions() const { return position_numbers_.missing_within(); }
    std::int64_t missing_figures() const { return figure_numbers_.missing_within(); }
    std::int64_t missing_changes() const { return change_numbers_.missing_within(); }
    /// From the axis's own messages; nullopt if they do not contain it.
    std::optional<double> steps_per_mm() const { return steps_per_mm_; }
    /// The steps from the last recorded step to the last position message. If these agree, the largest distance of any
    /// position message in between, since the axis may have returned. Not 0 if the log ends too early for these steps,
    /// or if its end is lost.
    std::int64_t unrecorded_steps() const;

private:
    std::int64_t unrecorded_at(const PositionSample& sample) const;
    bool has_new_zero(const PositionSample& sample) const;

    std::string name_;
    AxisStatistics statistics_;
    Trace trace_;
    LateFigures late_;
    Course slack_;
    std::unique_ptr<StepCsv> step_csv_;
    std::unique_ptr<CsvFile> position_csv_;
    MessageNumbers position_numbers_;
    MessageNumbers figure_numbers_;  // of health messages
    MessageNumbers change_numbers_;  // of inputs and outputs
    std::int64_t positions_ = 0;
    std::int64_t following_error_ = 0;
    std::optional<double> commanded_acceleration_;
    std::int64_t first_position_steps_ = 0;
    std::optional<PositionSample> last_position_;
    std::optional<PositionSample> origin_;  // the first with the newest zero, until steps with it are recorded
    std::optional<PositionSample> farthest_position_;  // since the last message of steps
    std::optional<double> steps_per_mm_;
    StepStream stream_{{&statistics_}};
};

/// The minimum number of steps that an axis made and the log lacks.
std::int64_t missing_steps_of(const AxisLog& axis);

}  // namespace lockstep::analysis
