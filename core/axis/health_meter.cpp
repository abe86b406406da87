#include "core/axis/health_meter.hpp"

#include <algorithm>

namespace lockstep {
namespace {

constexpr std::int64_t kReportsPerSecond = 10;

std::uint32_t as_count(Ticks value) { return static_cast<std::uint32_t>(value.value); }

}  // namespace

Extremes RecentExtremes::all() const {
    Extremes all;
    for (const Extremes& period : periods_) { all.merge(period); }
    return all;
}

void RecentExtremes::begin_period() {
    newest_ = (newest_ + 1) % periods_.size();
    periods_[newest_] = {};
}

HealthMeter::HealthMeter(MotorIndex motor, Identity identity, std::int64_t tick_ns)
    : motor_(motor), identity_(identity), period_{1'000'000'000 / kReportsPerSecond / tick_ns} {}

void HealthMeter::look(Tick now, const DeviceStatus* device) {
    now_ = now;
    const bool is_moving = device != nullptr && device->moving;
    if (!is_moving) { last_step_.reset(); }  // a standstill is no interval between steps
    if (device == nullptr || (device->finished && device->run == run_)) { newest_setpoint_.reset(); }
    if (device != nullptr) { free_segments_.add({device->free_segments}); }
}

void HealthMeter::take(const AxisOutputs& out) {
    for (const DeviceOrder& order : out.orders) { take_order(order); }
    for (const AxisNotice& notice : out.notices) {
        refused_commands_ += notice.kind == AxisNotice::Kind::CommandRefused ? 1 : 0;
    }
    if (out.state) { refused_frames_ = out.state->refused_frames; }
    for (const ExecutedTrack& track : out.tracks) { tracks_.push_back(track); }
}

/// A frame is loaded in the loop in which it arrived. Frames of an axis's own moves do not count.
void HealthMeter::take_order(const DeviceOrder& order) {
    if (const auto* run = std::get_if<device::BeginRun>(&order)) {
        run_ = run->run;
        own_run_ = run->own;
    }
    const auto* frame = std::get_if<device::LoadFrame>(&order);
    if (frame == nullptr || own_run_) { return; }
    slack_.add(frame->start - now_);
    newest_setpoint_ = frame->last ? std::nullopt : std::optional(now_);
}

void HealthMeter::step(StepEdge step) {
    if (last_step_) { interval_.add(step.tick - *last_step_); }
    last_step_ = step.tick;
    lateness_of_.made(step);
}

void HealthMeter::end_loop(std::uint32_t free_captures) {
    free_captures_.add({free_captures});
    for (const ExecutedTrack& track : tracks_) {
        const bool is_own = track.epoch == 0;  // an own move keeps the device's ticks and ignores machine time
        lateness_of_.ran(track, [&](Ticks late) {
            if (!is_own) { lateness_.add(late); }
        });
    }
    tracks_.clear();
}

void HealthMeter::loop_took(Ticks time) { loops_[loop_count_++ % kLoops] = time; }

LoopTime HealthMeter::loop_time() const {
    const std::size_t count = std::min(loop_count_, kLoops);
    if (count == 0) { return {}; }
    std::array<Ticks, kLoops> sorted = loops_;
    const auto at = [&](std::size_t percent) {
        const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(count);
        const auto nth = sorted.begin() + static_cast<std::ptrdiff_t>((count - 1) * percent / 100);
        std::nth_element(sorted.begin(), nth, end);
        return *nth;
    };
    return {.p50 = at(50), .p99 = at(99), .most = at(100)};
}

std::optional<AxisHealth> HealthMeter::report(Ticks clock_error, RefusalCounts refused) {
    if (!reported_) { reported_ = now_; }
    if (now_ - *reported_ < period_) { return std::nullopt; }
    reported_ = now_;
    refused.frames = refused_frames_;
    refused.commands = refused_commands_;
    const AxisHealth health{
        .identity = identity_,
        .axis = static_cast<std::uint32_t>(motor_),
        .tick = now_,
        .step_lateness = lateness_.all(),
        .step_interval = interval_.all(),
        .setpoint_slack = slack_.all(),
        .least_free_segments = as_count(free_segments_.all().least),
        .least_free_captures = as_count(free_captures_.all().least),
        .loop = loop_time(),
        .setpoint_age = newest_setpoint_ ? std::optional(now_ - *newest_setpoint_) : std::nullopt,
        .clock_error = clock_error,
        .refused = refused,
    };
    begin_period();
    return health;
}

void HealthMeter::begin_period() {
    for (RecentExtremes* figure : {&lateness_, &interval_, &slack_, &free_segments_, &free_captures_}) {
        figure->begin_period();
    }
}

}  // namespace lockstep
