// The log of a replay: the recorded log with the steps that the devices made in place of the recorded ones.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "clients/replay/device_replay.hpp"
#include "services/record/reading/log_read.hpp"
#include "services/record/record_sink.hpp"
#include "services/record/step_batcher.hpp"

namespace lockstep::replay {

/// The steps of one axis, as its process would have recorded them.
class ReplayedSteps {
public:
    /// `sink` must outlive this object.
    ReplayedSteps(const std::string& machine, const std::string& axis, RecordSink& sink);

    void take(const MadeStep& step);
    /// The time of the recorded log's last run, in microseconds of machine time.
    void set_time(std::int64_t utime) { utime_ = utime; }
    void finish();

private:
    void publish(step_batch_t& batch);

    std::string machine_;
    std::string axis_;
    std::string channel_;
    RecordSink& sink_;
    std::optional<StepBatcher> batcher_;  // of the recorded process
    std::int64_t incarnation_ = 0;
    std::int64_t utime_ = 0;
    std::optional<MadeStep> first_;  // the first step not published yet
    MadeStep last_;
};

/// Passes all messages but steps on unchanged.
class ReplayedLog {
public:
    explicit ReplayedLog(RecordSink& sink) : sink_(sink) {}

    ReplayedSteps& steps(const std::string& machine, const std::string& axis);
    void take(const run_t& message);
    void take(const axis_position_t& message);
    void take(const axis_health_t& message);
    void take(const channel_event_t& message);
    void take(const job_t& message);
    void take(const program_event_t& message);
    void take(const program_part_t& message);
    void finish();

private:
    RecordSink& sink_;
    std::map<std::pair<std::string, std::string>, ReplayedSteps> axes_;
};

}  // namespace lockstep::replay
