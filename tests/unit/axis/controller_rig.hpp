// The controller of one axis of two. Its device and its peers are written by hand. It runs one loop per slot.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "core/axis/axis_controller.hpp"
#include "core/methods/paper_steps.hpp"
#include "tests/unit/axis/known_epoch.hpp"
#include "tests/unit/axis/pair_machine.hpp"

namespace lockstep {

class ControllerRig : public testing::Test {
protected:
    static constexpr std::int64_t kSlot = 1000;  // ticks

    static MachineConfig machine() { return pair_machine(); }
    static DeviceStatus resting_device() {
        return {.power_up = 9, .run = 3, .run_asked = 3, .finished = true, .free_segments = 1000};
    }
    /// The position that the previous process of axis 0 kept: it makes the axis homed.
    static KeptPosition kept() { return {scale_of(machine(), MotorIndex{0}), 9, 3, {}, 0, 0}; }

    /// Runs one loop at the beginning of a slot, with the messages given since the last loop.
    AxisOutputs loop(Slot at) {
        slot = at;
        device.now = {at * kSlot};
        AxisOutputs out = axis.step({.now = {at * kSlot},
                                     .device = device,
                                     .frames = frames,
                                     .peers = peers,
                                     .coordinator = coordinator,
                                     .commands = commands,
                                     .requests = requests,
                                     .clock_error = {}});
        frames.clear();
        peers.clear();
        coordinator.clear();
        commands.clear();
        requests.clear();
        if (out.state) { state = *out.state; }
        return out;
    }
    /// Gives the owner's state of this slot to the next loop.
    void owner_reports(Slot at, Epoch epoch = 0) {
        coordinator.push_back({.term = kTerm, .stamp = at, .phase = MachinePhase::Idle, .epoch = epoch});
    }
    /// Runs a loop in each slot from `from` to `to`, both included. The owner reports in each.
    void owned(Slot from, Slot to, Epoch epoch = 0) {
        for (Slot at = from; at <= to; ++at) {
            owner_reports(at, epoch);
            loop(at);
        }
    }
    void command(AxisCommandKind kind, std::int64_t target_steps = 0) {
        commands.push_back(
            {.term = kTerm, .sequence = ++sequence_, .axis = 0, .kind = kind, .target_steps = target_steps});
    }
    template <typename Order>
    static std::vector<Order> orders_of(const AxisOutputs& out) {
        std::vector<Order> found;
        for (const DeviceOrder& order : out.orders) {
            if (const auto* one = std::get_if<Order>(&order)) { found.push_back(*one); }
        }
        return found;
    }
    static bool has_notice(const AxisOutputs& out, AxisNotice::Kind kind, FaultCode fault = FaultCode::None) {
        for (const AxisNotice& notice : out.notices) {
            if (notice.kind == kind && notice.fault == fault) { return true; }
        }
        return false;
    }

    AxisController axis{MotorIndex{0}, machine(), 77, 5, methods::begin_steps, kept()};
    DeviceStatus device = resting_device();
    std::vector<Frame> frames;
    std::vector<AxisState> peers;
    std::vector<MachineState> coordinator;
    std::vector<AxisCommand> commands;
    std::vector<Command> requests;
    AxisState state;
    Slot slot = 0;

private:
    std::uint64_t sequence_ = 0;
};

}  // namespace lockstep
