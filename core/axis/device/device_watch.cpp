#include "core/axis/device/device_watch.hpp"

#include <algorithm>
#include <utility>

#include "core/protocol/rules.hpp"

namespace lockstep {
namespace {

std::string text(Tick tick) { return std::to_string(tick.value); }

}  // namespace

DeviceWatch::DeviceWatch(const MachineConfig& machine)
    : slot_(machine.slot_ticks()), patience_(slot_ * rules::silence_slots(machine.timing)) {}

void DeviceWatch::take(const DeviceOrder& order) {
    if (const auto* begin = std::get_if<device::BeginRun>(&order)) {
        run_ = begin->run;
        loaded_ = 0;
        ends_ = last_ ? last_->now : Tick{};
    } else if (const auto* load = std::get_if<device::LoadFrame>(&order)) {
        loaded_ = load->number;
        ends_ = std::max(ends_, load->start + total_ticks(load->track.body) + total_ticks(load->track.tail));
    }
}

std::optional<std::string> DeviceWatch::doubt_of(Tick own, const DeviceStatus& status) {
    const Ticks passed = pass_until(own);
    if (auto what = contradiction(status)) { return what; }
    const bool stands = last_ && status.now == last_->now;
    stood_ = stands ? stood_ + passed : Ticks{};
    overdue_ = is_overdue(status) ? overdue_ + passed : Ticks{};
    last_ = status;
    if (stood_ > patience_) {
        return "its clock stopped at tick " + text(status.now) + ": its process or its board has stopped";
    }
    if (overdue_ > patience_) {
        return "its run " + std::to_string(run_) + " has not ended at tick " + text(status.now) +
               ", although its frames end at tick " + text(ends_);
    }
    return std::nullopt;
}

std::optional<std::string> DeviceWatch::doubt_of_silence(Tick own) {
    stood_ += pass_until(own);
    if (stood_ <= patience_) { return std::nullopt; }
    return "it has not answered: its process, its board or the link to it has stopped";
}

/// Returns the time since the last look that counts.
Ticks DeviceWatch::pass_until(Tick own) {
    const Tick before = std::exchange(looked_, own).value_or(own);
    return std::clamp(own - before, Ticks{}, slot_);
}

/// Applies to a run that this process ordered. Switches and vetoes can only end it sooner.
bool DeviceWatch::is_overdue(const DeviceStatus& status) const {
    const bool ended = status.run == run_ && status.finished;
    return run_ != 0 && !ended && status.now > ends_;
}

/// Returns what contradicts a device that counts ticks and pulses one by one and runs only what it was given.
std::optional<std::string> DeviceWatch::contradiction(const DeviceStatus& status) const {
    if (!last_) { return std::nullopt; }
    if (status.power_up != last_->power_up) { return "it was powered up again"; }
    if (status.now < last_->now) {
        return "its clock went back from tick " + text(last_->now) + " to " + text(status.now);
    }
    const Displacement moved = status.position - last_->position;
    const Displacement most = Displacement::steps((status.now - last_->now).value) + Displacement::steps(1);
    if (moved > most || moved < -most) {
        return "its count changed from " + std::to_string(last_->position.count()) + " to " +
               std::to_string(status.position.count()) + " between ticks " + text(last_->now) + " and " +
               text(status.now);
    }
    const std::uint64_t asked = run_ != 0 ? run_ : last_->run_asked;
    if (status.run_asked != asked) {
        return "it reports an order for run " + std::to_string(status.run_asked) +
               "; the last run that this axis ordered is " + std::to_string(asked);
    }
    const bool is_known = status.run == last_->run || status.run == asked;
    if (!is_known || (status.run == run_ && run_ != 0 && status.frame > loaded_)) {
        return "it reports frame " + std::to_string(status.frame) + " of run " + std::to_string(status.run) +
               "; the last frame loaded is " + std::to_string(loaded_) + " of run " + std::to_string(asked);
    }
    return std::nullopt;
}

}  // namespace lockstep
