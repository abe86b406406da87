// An axis controller connected to its device. An axis's process runs it in each loop, live or in virtual time.
#pragma once

#include <chrono>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/axis/axis_controller.hpp"
#include "core/axis/device/device_watch.hpp"
#include "core/axis/device_time.hpp"
#include "core/axis/health_meter.hpp"
#include "core/clock/clock_reset.hpp"
#include "core/flight/axis_flight.hpp"
#include "services/axis/device_port.hpp"
#include "services/axis/input_edges.hpp"

namespace lockstep {

/// Opens an axis's device. `own` is the current reading of this process's clock. Error: why there is no device. Never
/// waits.
using OpenDevice = std::function<std::expected<std::unique_ptr<DevicePort>, std::string>(Tick own)>;

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
        std::size_t axis = 0;
        MachineConfig machine;
        Identity identity = 0;
        std::uint64_t config_hash = 0;
        KeptOrNot kept = std::unexpected(FaultCode::PositionNotKept);
    };
    using OnStep = DevicePort::OnStep;
    using OnChannel = DevicePort::OnChannel;

    /// While the device is missing or lost, the node searches for it every kSeekPeriod.
    AxisNode(const Setup& setup, OpenDevice open);
    static constexpr std::chrono::milliseconds kSeekPeriod{200};

    /// Runs one loop. `own` is the reading of this process's clock, which is machine time if the clock is shared. The
    /// node reads its device, decides, and gives the device its orders. It passes every step read since the last loop
    /// to on_step, in order, in the device's time. A device error becomes a fault. Before the node
    /// closes a failed device, it orders the device to rest, in case the device still runs. The node decides and
    /// publishes nothing before it knows the machine time. The result is valid until the next loop.
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
    /// Number of device errors so far: refused orders and lost devices.
    std::uint64_t troubles() const { return troubles_; }
    std::uint64_t lost_captures() const { return lost_before_ + lost_captures_; }
    std::uint64_t lost_channel_events() const { return has_device() ? found_->port->lost_channel_events() : 0; }
    /// Why the node has no device. Empty if it has one, or if the search has just begun.
    std::string lacks() const { return has_device() || is_looking() ? std::string() : lacks_; }
    /// Upper bound of the error of `now`.
    Ticks clock_error() const { return time_.error(); }
    /// The coordinator's clock restarted, so this process must end and be started again.
    bool must_restart() const { return must_restart_; }

    /// The error of the last order that the device refused; empty if it refused none.
    const std::string& trouble() const { return trouble_; }
    /// Machine time at the last step, if it is known.
    Tick now() const { return time_.clocks().now(); }
    bool knows_time() const { return knows_time_; }
    const AxisController& controller() const { return controller_; }

private:
    void seek_device(Tick own);
    std::expected<void, std::string> find_device(Tick own);
    void lose_device(Tick own, const std::string& why);
    void look(Tick own);
    std::optional<DeviceClocks::Device> device_clock() const;
    void control(const AxisMail& mail);
    void drain(Tick own, const OnStep& on_step, const ClockView& machine_time);
    void drain_channels(Tick own);
    void note(std::string trouble);
    void give(const std::vector<DeviceOrder>& orders);

    /// A device that was found. The memory of a dead device looks the same, but its clock stands still.
    struct Found {
        std::unique_ptr<DevicePort> port;
        DeviceWatch watch;
        std::optional<DeviceReading> newest;
        bool is_new = false;        // `newest` was not there in the loop before
        std::optional<Tick> first;  // its first clock reading
        bool lives = false;         // its clock advances
    };
    bool has_device() const { return found_ && found_->lives; }
    /// At the start the node reports nothing until it is clear whether a device exists.
    bool is_looking() const { return found_ && !found_->lives && !has_begun_; }

    OpenDevice open_;
    MachineConfig machine_;
    std::optional<Found> found_;
    std::optional<Tick> sought_;  // last search, on this process's clock; nullopt: search at once
    std::string lacks_;
    AxisController controller_;
    bool has_begun_ = false;
    DeviceTime time_;
    bool knows_time_ = false;
    ClockReset clock_reset_;
    bool must_restart_ = false;
    DeviceStatus status_;              // the last status read
    std::uint64_t lost_captures_ = 0;  // of this device
    std::uint64_t lost_before_ = 0;    // of the devices before it
    std::string trouble_;
    std::uint64_t troubles_ = 0;
    HealthMeter* meter_ = nullptr;  // null: nothing is measured
    AxisFlight* flight_ = nullptr;  // null: nothing is noted
    OnChannel on_channel_ = [](const ChannelEvent&) {};
    InputEdges edges_;
    bool failed_ = false;  // a device order failed since the last control step
    AxisOutputs out_;      // of the last loop
};

}  // namespace lockstep
