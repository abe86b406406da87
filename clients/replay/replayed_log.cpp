#include "clients/replay/replayed_log.hpp"

#include <algorithm>

#include "services/wire/lcm/lcm_channels.hpp"

namespace lockstep::replay {

ReplayedSteps::ReplayedSteps(const std::string& machine, const std::string& axis, RecordSink& sink)
    : machine_(machine), axis_(axis), channel_(channels_of(machine, axis).steps), sink_(sink) {}

void ReplayedSteps::take(const MadeStep& step) {
    const std::int64_t before = step.count - step.edge.direction;
    if (!batcher_ || incarnation_ != step.incarnation) {
        finish();
        incarnation_ = step.incarnation;
        batcher_.emplace(
            StepBatcher::Source{
                .machine = machine_, .axis = axis_, .incarnation = static_cast<std::uint64_t>(incarnation_)},
            before, [this](step_batch_t& batch) { publish(batch); });
    }
    if (batcher_->position_steps() != before) { batcher_->set_position(before); }  // the axis was zeroed
    batcher_->poll(step.edge.tick);
    batcher_->add(step.edge);
    if (!first_) { first_ = step; }
    last_ = step;
}

void ReplayedSteps::publish(step_batch_t& batch) {
    batch.utime = utime_;
    batch.ahead_first = (first_->commanded - first_->edge.tick).value;
    batch.ahead_last = (last_.commanded - last_.edge.tick).value;
    batch.clock_error = std::max(first_->clock_error, last_.clock_error).value;
    sink_.publish(channel_, batch);
    first_.reset();
}

void ReplayedSteps::finish() {
    if (batcher_) { batcher_->flush(); }
}

ReplayedSteps& ReplayedLog::steps(const std::string& machine, const std::string& axis) {
    return axes_.try_emplace({machine, axis}, machine, axis, sink_).first->second;
}

void ReplayedLog::take(const run_t& message) {
    if (const auto found = axes_.find({message.machine, message.axis}); found != axes_.end()) {
        found->second.set_time(message.utime);
    }
    sink_.publish(channels_of(message.machine, message.axis).run, message);
}

void ReplayedLog::take(const axis_position_t& message) {
    sink_.publish(channels_of(message.machine, message.axis).position, message);
}

void ReplayedLog::take(const axis_health_t& message) {
    sink_.publish(channels_of(message.machine, message.axis).health, message);
}

void ReplayedLog::take(const channel_event_t& message) {
    sink_.publish(channels_of(message.machine, message.axis).channels, message);
}

void ReplayedLog::take(const program_part_t& message) { sink_.publish(program_channel(message.machine), message); }

void ReplayedLog::take(const job_t& message) { sink_.publish(job_channel(message.machine), message); }

void ReplayedLog::take(const program_event_t& message) { sink_.publish(event_channel(message.machine), message); }

void ReplayedLog::finish() {
    for (auto& [name, steps] : axes_) { steps.finish(); }
}

}  // namespace lockstep::replay
