#include "services/record/step_batcher.hpp"

#include <algorithm>
#include <limits>

#include "core/machine.hpp"

namespace lockstep {
namespace {

Ticks period_in_ticks(std::int64_t tick_ns) {
    return {std::max<std::int64_t>(1, StepBatcher::kBatchPeriod.count() / tick_ns)};
}

Tick first_turn(Ticks period, std::uint32_t axis_index) {
    constexpr auto kTurns = static_cast<std::int64_t>(kMaxAxes);
    return {period.value * (axis_index % kTurns) / kTurns};
}

}  // namespace

StepBatcher::StepBatcher(Source source, std::int64_t position_steps, Publish publish)
    : batch_{},
      publish_(std::move(publish)),
      period_(period_in_ticks(source.tick_ns)),
      due_(first_turn(period_, source.axis_index)) {
    batch_.machine = std::move(source.machine);
    batch_.axis = std::move(source.axis);
    batch_.incarnation = static_cast<std::int64_t>(source.incarnation);
    batch_.position_before = position_steps;
    batch_.delta_ticks.reserve(kMaxSteps);
    batch_.direction.reserve(kMaxSteps);
}

bool StepBatcher::joins(Tick tick) const {
    return batch_.count < kMaxSteps && (tick - last_step_).value <= std::numeric_limits<std::int32_t>::max();
}

void StepBatcher::add(StepEdge step) {
    if (batch_.count > 0 && !joins(step.tick)) { flush(); }
    if (batch_.count == 0) {
        batch_.first_tick = step.tick.value;
        last_step_ = step.tick;
    }
    batch_.delta_ticks.push_back(static_cast<std::int32_t>((step.tick - last_step_).value));
    batch_.direction.push_back(step.direction);
    ++batch_.count;
    moved_ += step.direction;
    last_step_ = step.tick;
}

void StepBatcher::poll(Tick now) {
    if (now < due_) { return; }
    const std::int64_t turns = (now - due_).value / period_.value + 1;  // missed turns are skipped
    due_ += period_ * turns;
    flush();
}

void StepBatcher::flush() {
    if (batch_.count == 0) { return; }
    publish_(batch_);
    ++batch_.sequence;
    batch_.position_before += moved_;
    moved_ = 0;
    batch_.count = 0;
    batch_.delta_ticks.clear();
    batch_.direction.clear();
}

void StepBatcher::set_position(std::int64_t position_steps) {
    flush();
    batch_.position_before = position_steps;
}

}  // namespace lockstep
