// The data that the parts of an axis share in one loop: the time, the axis's condition, its device, and the loop's
// outputs.
#pragma once

#include <optional>
#include <variant>

#include "core/axis/device/device_view.hpp"
#include "core/axis/device/held_frames.hpp"
#include "core/axis/state/axis_io.hpp"
#include "core/axis/state/axis_position.hpp"
#include "core/axis/state/order_log.hpp"
#include "core/axis/state/phase_machine.hpp"

namespace lockstep {

/// The state of the axis apart from its frames.
struct AxisCondition {
    PhaseMachine phases;
    AxisPosition position;
    OrderLog orders;

    /// The axis stands in a known place without a fault.
    bool is_ready() const { return position.homed() && phases.phase() == AxisPhase::Standby && !phases.has_fault(); }
    /// It may follow frames from where it rests.
    bool may_follow() const { return is_ready() || (position.is_assumed() && !phases.has_fault()); }
};

struct AxisLoop {
    Tick now;
    Slot slot;
    Slot next_state;  // the slot of the next state that it publishes
    AxisCondition& condition;
    DeviceView& device;
    AxisOutputs& out;

    bool publishes() const { return next_state == slot; }
    void notice(const AxisNotice& notice) { out.notices.push_back(notice); }

    /// Reports a fault. The open order fails, too. `number`: of AxisNotice.
    void fail(FaultCode fault, std::uint64_t number = 0) {
        condition.phases.fail(fault);
        condition.orders.end(fault);
        notice({AxisNotice::Kind::Fault, fault, number});
    }
    void refuse(const AxisCommand& order, FaultCode why) {
        notice({AxisNotice::Kind::CommandRefused, why, order.sequence});
        condition.orders.end(why);
    }

    void begin_own_run(Trigger trigger) {
        out.orders.emplace_back(device::BeginRun{.run = device.begin_run(), .trigger = trigger, .own = true});
    }
    /// A run of frames. Its pulses cease at a touch of this input of the device.
    void begin_run(const std::optional<TouchInput>& input, bool opens) {
        device::BeginRun begin{.run = device.begin_run()};
        if (input) {
            begin.trigger = opens ? Trigger::InputOpens : Trigger::InputCloses;
            begin.channel = input->channel;
        }
        out.orders.emplace_back(begin);
    }
    void load(const HeldFrame& frame) {
        AxisTrack track = frame.track;
        track.from = condition.position.in_device(track.from);
        out.orders.emplace_back(device::LoadFrame{frame.number, frame.start, frame.last, track});
        if (frame.outputs.empty()) { return; }
        out.orders.emplace_back(device::LoadOutputs{frame.number, frame.outputs});
        OutputTrack& outputs = std::get<device::LoadOutputs>(out.orders.back()).track;
        for (OutputChange& change : outputs.body) { count_by_device(change); }
        for (OutputChange& change : outputs.tail) { count_by_device(change); }
    }

private:
    void count_by_device(OutputChange& change) const {
        if (auto* places = std::get_if<ComparePosition>(&change.what)) {
            places->next += condition.position.zero_count();
        }
    }
};

}  // namespace lockstep
