#include "clients/analysis/measure/axis_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "services/record/reading/recycled.hpp"

namespace lockstep::analysis {

void AxisStatistics::on_batch(const StepBatch& batch) {
    if (batch.steps.empty()) { return; }
    if (!first_) { begin(batch.steps.front(), batch.position_before_steps); }
    const auto measured = std::make_shared<MeasuredSteps>();
    measured->edges = batch.steps;
    measured->position_before = batch.position_before_steps;
    measured->rates = Recycled<StepRates>::take(batch.steps.size());
    measured->clock_error = batch.clock_error;
    const bool joins = std::exchange(joined_, true) && last_;
    Tick before = joins ? last_->tick : batch.steps.front().tick;
    for (std::size_t i = 0; i < batch.steps.size(); ++i) {
        if (i > 0) { i += measure_blocks(batch, i, *measured); }
        if (i == batch.steps.size()) { break; }
        const StepEdge edge = batch.steps[i];
        if (i > 0) { before = batch.steps.tick(i - 1); }
        if (edge.tick - before > SpeedMeter::kRest) { show_rest(before, edge.tick); }
        measured->rates[i] = measure(edge, batch.device_tick(i));
    }
    last_ = {batch.steps.back().tick, batch.position_before_steps + batch.steps.change()};
    steps_ += static_cast<std::int64_t>(batch.steps.size());
    clock_error_ = std::max(clock_error_, batch.clock_error);
    if (listener_ != nullptr) { listener_->on_measured(lane_, measured); }
}

void AxisStatistics::on_break(const Break& what) {
    meter_.interrupt();
    ++break_count_;
    if (what.missing_batches > 0) {
        missing_batches_ += what.missing_batches;
        missing_batches_before_ += what.from ? 0 : what.missing_batches;
        missing_steps_ += std::abs(what.position_change);
        joined_ = false;
    }
    if (breaks_.size() < kBreaksKept) { breaks_.push_back(what); }
}

void AxisStatistics::on_contradiction(const Contradiction& what) {
    if (contradictions_.size() < kBreaksKept) { contradictions_.push_back(what); }
}

void AxisStatistics::finish() {
    meter_.interrupt();
    if (last_) { stand_at(last_->tick); }
}

void AxisStatistics::begin(StepEdge edge, std::int64_t position_before) {
    first_ = StepPlace{edge.tick, position_before + edge.direction};
    start_ = position_before;
    stand_at(edge.tick);
}

/// Measures as many of the steps from `from` on as can be measured in blocks. Returns their number.
std::size_t AxisStatistics::measure_blocks(const StepBatch& batch, std::size_t from, MeasuredSteps& measured) {
    if (!batch.device_steps.empty()) { return 0; }
    const StepSpan steps = batch.steps.subspan(from);
    std::size_t done = 0;
    while (const std::size_t taken = meter_.take_blocks(steps.subspan(done))) {
        measure_taken({&measured.rates[from + done], taken});
        done += taken;
    }
    return done;
}

/// Measures the steps that the meter took in blocks.
void AxisStatistics::measure_taken(std::span<StepRates> rates) {
    SpeedMeter::Block block;
    for (std::size_t i = 0; i < rates.size(); i += SpeedMeter::kBlock) {
        meter_.measure_block(block, &rates[i]);
        if (!keeps_curves_) { continue; }
        speed_.add_block(block.speed);
        acceleration_.add_block(block.acceleration);
    }
}

/// Speed and acceleration are by the device's clock, which the motor follows; their times are machine time.
inline StepRates AxisStatistics::measure(StepEdge edge, Tick by_device) {
    const auto speed = meter_.step({by_device, edge.direction});
    const auto& acceleration = meter_.acceleration();
    const Ticks ahead = edge.tick - by_device;
    if (speed && keeps_curves_) { speed_.add({speed->at + ahead, speed->value}); }
    if (acceleration && keeps_curves_) { acceleration_.add({acceleration->at + ahead, acceleration->value}); }
    return {speed ? static_cast<float>(std::abs(speed->value)) : 0,
            acceleration ? static_cast<float>(std::abs(acceleration->value)) : 0};
}

void AxisStatistics::stand_at(Tick tick) {
    speed_.add({tick, 0});
    acceleration_.add({tick, 0});
}

/// Speed and acceleration are 0 during a rest. Where steps are missing they are unknown.
void AxisStatistics::show_rest(Tick from, Tick until) {
    stand_at(from);
    stand_at(until);
}

}  // namespace lockstep::analysis
