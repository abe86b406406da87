// The seam between an axis and its device: all that the axis knows of the device is behind this interface. A port leads
// to registers in memory (services/axis/window_port.hpp), to a simulation, or over a link.
//
// No function waits. A device that answers late is read by its last answer until the next one arrives. Each answer has
// the interval of the host's clock in which it was made, so its age is known, and an estimate of the device's clock has
// an honest bound.
#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <optional>
#include <string>

#include "core/axis/device/device_reading.hpp"

namespace lockstep {

class DevicePort {
public:
    using OnStep = std::function<void(StepEdge)>;
    using OnChannel = std::function<void(const ChannelEvent&)>;

    virtual ~DevicePort() = default;

    virtual DeviceClock clock() const = 0;

    /// Returns the newest answer, which may be one that was returned before; nullopt before the first one. `own`: the
    /// process's clock. `run_asked` and `free_segments` include all orders given. Error: the device answers, but not as
    /// a device does, or a device that answers late refused an order. It is lost then.
    virtual std::expected<std::optional<DeviceReading>, std::string> read(Tick own) = 0;

    /// Gives the device an order. Orders arrive in order, perhaps late. Errors, which change nothing: a frame that does
    /// not fit into the device, has no body, or precedes any run; a run number that is 0 or not new.
    virtual std::expected<void, std::string> apply(const DeviceOrder& order) = 0;

    /// Passes to on_step, in order, every step that the device had captured at the newest answer, once. Returns for how
    /// many further steps the device had room before. Error: impossible steps.
    virtual std::expected<std::uint32_t, std::string> drain(const OnStep& on_step) = 0;
    /// Steps that were made while the device had no room to capture them, since its power-up.
    virtual std::uint64_t lost_captures() const = 0;

    /// Passes to on_channel, in order, every change of an input or output that the device had noted at the newest
    /// answer, once. Error: impossible changes.
    virtual std::expected<void, std::string> drain_channels(const OnChannel& on_channel) = 0;
    /// Changes that the device had no room to note, since its power-up.
    virtual std::uint64_t lost_channel_events() const = 0;

    /// The end of a message about a device that no longer answers: what to check. Empty if the port knows nothing.
    virtual std::string remedy() const { return {}; }

protected:
    DevicePort() = default;
    DevicePort(const DevicePort&) = default;
    DevicePort& operator=(const DevicePort&) = default;
};

}  // namespace lockstep
