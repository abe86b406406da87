// An axis controller and its device, joined: what an axis's process runs each loop, live or in virtual time.
#pragma once

#include <chrono>
#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "core/axis/axis_controller.hpp"
#include "core/axis/device/device_watch.hpp"
#include "core/axis/device_time.hpp"
#include "core/axis/health_meter.hpp"
#include "core/clock/clock_reset.hpp"
#include "core/flight/axis_flight.hpp"
#include "services/axis/device_driver.hpp"
#include "sim_fpga/device.hpp"

namespace lockstep {

/// The device of an axis: a window onto its registers and, if it is simulated here, the device behind it.
struct AxisDevice {
    RegisterWindow window;
    std::unique_ptr<SimulatedDevice> simulated;  // null: the device is another process's, or hardware
    bool shares_clock = false;                   // it counts the ticks of this process's clock
};

/// A simulated device in this process, powered up at `now`.
AxisDevice simulated_device(const AxisConfig& axis, std::int64_t tick_ns, Tick now);

/// Opens an axis's device when this process's clock reads `own`. Error: why it is not there. Never waits.
using OpenDevice = std::function<std::expected<AxisDevice, std::string>(Tick own)>;

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
    using OnStep = std::function<void(StepEdge)>;

    /// A device that is missing or lost is searched for again every kSeekPeriod.
    AxisNode(const Setup& setup, OpenDevice open);
    static constexpr std::chrono::milliseconds kSeekPeriod{200};

    /// One loop when this process's clock reads `own`, which is machine time if the clock is shared: lets a simulated
    /// device run up to it, decides, and gives the device its orders. Every step made since the last loop goes to
    /// on_step, in order, in the device's time. An error of the device becomes a fault. A device that is given up is
    /// closed; before that it is ordered to come to rest, in case it goes on running. The node decides and publishes
    /// nothing before it knows the machine time. What is returned is valid until the next loop.
    const AxisOutputs& step(Tick own, const AxisMail& mail, const OnStep& on_step);

    /// The two halves of a loop: the decisions, and the orders to the device.
    const AxisOutputs& decide(Tick own, const AxisMail& mail, const OnStep& on_step);
    void carry_out(Tick own, const AxisOutputs& decided);

    /// From the next step on, every loop is measured. `meter` outlives the node.
    void measure(HealthMeter& meter) { meter_ = &meter; }
    /// From the next step on, decisions are noted. `flight` outlives the node.
    void note_in(AxisFlight& flight) { flight_ = &flight; }
    /// Errors reported about devices: refused orders, lost devices, and steps without a recorded time.
    std::uint64_t troubles() const { return troubles_; }
    std::uint64_t lost_captures() const { return lost_before_ + lost_captures_; }
    /// Why it has no device; empty: it has one, or the search has just begun.
    std::string lacks() const { return has_device() || is_looking() ? std::string() : lacks_; }
    /// Upper bound of the error of `now`.
    Ticks clock_error() const { return time_.error(); }
    /// The coordinator's clock restarted: this process must end, and be started again.
    bool must_restart() const { return must_restart_; }

    /// The last error of the device; empty: there was none.
    const std::string& trouble() const { return trouble_; }
    /// Machine time at the last step, if it is known.
    Tick now() const { return time_.now(); }
    bool knows_time() const { return knows_time_; }
    const AxisController& controller() const { return controller_; }

private:
    void seek_device(Tick own);
    std::expected<void, std::string> find_device(Tick own);
    void lose_device(Tick own, const std::string& why);
    void advance_simulated(Tick own);
    void look(Tick own);
    void control(const AxisMail& mail);
    void drain(Tick own, const OnStep& on_step, const ClockView& machine_time);
    void note(std::string trouble);
    void give(const std::vector<DeviceOrder>& orders);

    /// A device that was found. A dead device's memory looks the same; only its clock stands still.
    struct Found {
        AxisDevice device;
        DeviceDriver driver;
        DeviceWatch watch;
        std::optional<Tick> first;  // its first clock reading
        bool lives = false;         // its clock advances
    };
    bool has_device() const { return found_ && found_->lives; }
    /// At the start: the node reports nothing until it is clear whether there is a device.
    bool is_looking() const { return found_ && !found_->lives && !has_begun_; }

    OpenDevice open_;
    MachineConfig machine_;
    std::optional<Found> found_;
    std::optional<Tick> sought_;  // the last search, by this process's clock; nothing: search at once
    std::string lacks_;
    AxisController controller_;
    bool has_begun_ = false;
    DeviceTime time_;
    bool knows_time_ = false;
    ClockReset clock_reset_;
    bool must_restart_ = false;
    DeviceStatus status_{.free_segments = registers::kSegmentRingEntries};  // the last status read
    std::uint64_t lost_captures_ = 0;                                       // of this device
    std::uint64_t lost_before_ = 0;                                         // of the devices before it
    std::string trouble_;
    std::uint64_t troubles_ = 0;
    HealthMeter* meter_ = nullptr;  // null: nothing is measured
    AxisFlight* flight_ = nullptr;  // null: nothing is noted
    bool failed_ = false;           // since the controller was last informed
    AxisOutputs out_;               // of the last loop
};

}  // namespace lockstep
