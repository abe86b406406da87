// The host's side of the register map: an axis controller's orders become register writes, registers become values.
// Nothing read from the window is trusted: an impossible value is an error with the value and the remedy.
#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "core/axis/device/device.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

/// One at a time per device. It continues where its predecessor left the rings.
class DeviceDriver {
public:
    /// tick_ns: the configuration's. Errors: no device, another version of the map, another tick, rings whose
    /// ends contradict each other.
    static std::expected<DeviceDriver, std::string> attach(RegisterWindow window, std::int64_t tick_ns);

    /// One consistent reading, without waiting: while the device is in the middle of an update it returns the reading
    /// before. Error if that goes on for kMaxStaleReads reads, if there is no reading before, or if the registers are
    /// impossible or no longer a device's.
    /// If a device stops between updates, `now` stands still.
    std::expected<DeviceStatus, std::string> read();
    static constexpr int kMaxStaleReads = 1000;

    /// Error, and nothing has changed: a frame that does not fit the ring, has no body, or precedes any run; a run
    /// whose number is not new.
    std::expected<void, std::string> apply(const DeviceOrder& order);

    /// Calls back with every step made since the last call, in order. Returns how many. Error: impossible ring ends, or
    /// ticks that do not rise.
    std::expected<std::uint64_t, std::string> drain_capture(const std::function<void(StepEdge)>& on_step);
    /// Steps since the device's power-up that were made while the capture ring was full.
    std::uint64_t lost_captures() const { return window_.load(registers::kCaptureLost); }

private:
    using Result = std::expected<void, std::string>;
    DeviceDriver(RegisterWindow window, std::int64_t tick_ns) : window_(std::move(window)), tick_ns_(tick_ns) {}

    Result apply_one(const device::BeginRun& order);
    Result apply_one(const device::LoadFrame& order);
    Result apply_one(const device::Arm& order);
    Result apply_one(const device::Veto& order);
    Result apply_one(const device::StopNow& order);
    std::expected<DeviceStatus, std::string> stale_look();
    DeviceStatus read_words() const;
    std::int64_t signed_word(std::size_t offset) const { return static_cast<std::int64_t>(window_.load(offset)); }

    RegisterWindow window_;
    std::int64_t tick_ns_;
    std::optional<DeviceStatus> last_look_;
    std::optional<Tick> last_step_;
    int stale_reads_ = 0;
};

}  // namespace lockstep
