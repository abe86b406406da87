// An axis controller connected to its device. An axis's process runs it in each loop, live or in virtual time.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/axis/axis_controller.hpp"
#include "core/axis/device_time.hpp"
#include "core/axis/health_meter.hpp"
#include "core/clock/clock_reset.hpp"
#include "core/flight/axis_flight.hpp"
#include "services/axis/axis_device.hpp"
#include "services/axis/input_edges.hpp"

namespace lockstep {

/// The messages of one loop.
struct AxisMail {
    std::span<const Frame> frames;
    std::span<const AxisState> peers;
    std::span<const MachineState> coordinator;
    std::span<const AxisCommand> commands;
    std::span<const Command> requests;  // from clients
    std::span<const ClockExchange> clock;
};

class AxisNode {
public:
    struct Setup {
        MotorIndex motor;
        MachineConfig machine;
        Identity identity = 0;
        std::uint64_t config_hash = 0;
        KeptOrNot kept = std::unexpected(FaultCode::PositionNotKept);
    };
    using OnStep = DevicePort::OnStep;
    using OnChannel = DevicePort::OnChannel;

    AxisNode(const Setup& setup, OpenDevice open);

    /// Runs one loop. `own` is the reading of this process's clock, which is machine time if the clock is shared. The
    /// node reads its device, decides, and gives the device its orders. It passes every step read since the last loop
    /// to on_step, in order, in the device's time. A device error becomes a fault. The node decides and publishes
    /// nothing before it knows the machine time. The result is valid until the next loop.
    const AxisOutputs& step(Tick own, const AxisMail& mail, const OnStep& on_step);

    /// The two halves of step(): decide() makes the decisions, carry_out() gives the device its orders.
    const AxisOutputs& decide(Tick own, const AxisMail& mail, const OnStep& on_step);
    void carry_out(const AxisOutputs& decided);

    /// Measures every loop from the next step on. `meter` must outlive the node.
    void measure(HealthMeter& meter) { meter_ = &meter; }
    /// Notes the decisions from the next step on. `flight` must outlive the node.
    void note_in(AxisFlight& flight) { flight_ = &flight; }
    /// Passes every change of an input or output of the device from the next step on, in order, in the device's time.
    void pass_channels(OnChannel on_channel) { on_channel_ = std::move(on_channel); }
    const AxisDevice& device() const { return device_; }
    /// Why the node has no device. Empty if it has one, or if the search has just begun.
    std::string lacks() const { return device_.is_present() || is_looking() ? std::string() : device_.lacks(); }
    /// Upper bound of the error of `now`.
    Ticks clock_error() const { return time_.error(); }
    /// The coordinator's clock restarted, so this process must end and be started again.
    bool must_restart() const { return must_restart_; }

    /// Machine time at the last step, if it is known.
    Tick now() const { return time_.clocks().now(); }
    bool knows_time() const { return knows_time_; }
    const AxisController& controller() const { return controller_; }

private:
    void control(const AxisMail& mail);
    void drain(Tick own, const OnStep& on_step, const ClockView& machine_time);
    void drain_channels(Tick own);

    /// At the start the node reports nothing until it is clear whether a device exists.
    bool is_looking() const { return device_.is_in_doubt() && !has_begun_; }

    AxisDevice device_;
    AxisController controller_;
    bool has_begun_ = false;
    DeviceTime time_;
    bool knows_time_ = false;
    ClockReset clock_reset_;
    bool must_restart_ = false;
    HealthMeter* meter_ = nullptr;  // null: nothing is measured
    AxisFlight* flight_ = nullptr;  // null: nothing is noted
    OnChannel on_channel_ = [](const ChannelEvent&) {};
    InputEdges edges_;
    AxisOutputs out_;  // of the last loop
};

}  // namespace lockstep
