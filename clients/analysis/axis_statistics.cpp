#include "clients/analysis/axis_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace lockstep::analysis {

void AxisStatistics::on_batch(const StepBatch& batch) {
    std::int64_t position = batch.position_before_steps;
    for (const StepEdge& edge : batch.steps) { take(edge, position += edge.direction); }
    steps_ += static_cast<std::int64_t>(batch.steps.size());
    clock_error_ = std::max(clock_error_, batch.clock_error);
}

void AxisStatistics::on_break(const Break& what) {
    meter_.interrupt();
    ++break_count_;
    if (what.missing_batches > 0) {
        missing_batches_ += what.missing_batches;
        missing_steps_ += std::abs(what.position_change);
        joined_ = false;
    }
    if (breaks_.size() < kBreaksKept) { breaks_.push_back(what); }
}

void AxisStatistics::finish() {
    meter_.interrupt();
    if (last_) { stand_at(last_->tick); }
}

void AxisStatistics::take(StepEdge edge, std::int64_t position) {
    if (!first_) {
        first_ = StepPlace{edge.tick, position};
        start_ = position - edge.direction;
        lowest_ = highest_ = start_;
        stand_at(edge.tick);
    }
    lowest_ = std::min(lowest_, position);
    highest_ = std::max(highest_, position);
    show_rest(edge.tick);
    measure(edge, position);
    last_ = StepPlace{edge.tick, position};
}

void AxisStatistics::measure(StepEdge edge, std::int64_t position) {
    const auto speed = meter_.step(edge);
    const auto& acceleration = meter_.acceleration();
    if (speed) { speed_.add(*speed); }
    if (acceleration) { acceleration_.add(*acceleration); }
    if (merge_ == nullptr) { return; }
    const auto amount = [](const std::optional<Sample>& of) {
        return of ? static_cast<float>(std::abs(of->value)) : 0.0F;
    };
    merge_->take(lane_, {edge.tick, position, amount(speed), amount(acceleration), edge.direction});
}

void AxisStatistics::stand_at(Tick tick) {
    speed_.add({tick, 0});
    acceleration_.add({tick, 0});
}

/// A rest is 0 from its first instant to its last; where steps are missing nobody knows.
void AxisStatistics::show_rest(Tick until) {
    if (!std::exchange(joined_, true) || !last_ || until - last_->tick <= SpeedMeter::kRest) { return; }
    stand_at(last_->tick);
    stand_at(until);
}

}  // namespace lockstep::analysis
