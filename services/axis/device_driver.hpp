// The host's side of the register map. It turns an axis controller's orders into register writes, and registers into
// values. It trusts nothing that it reads: an impossible value is an error that states the value and the remedy.
#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "core/axis/device/device.hpp"
#include "core/hardware/device_abilities.hpp"
#include "sim_fpga/register_ring.hpp"
#include "sim_fpga/register_window.hpp"

namespace lockstep {

/// Only one driver may use a device at a time. It continues where its predecessor left the rings.
class DeviceDriver {
public:
    /// Reads what the device is built for, and changes nothing. `tick_ns` is the configured tick. Errors: no device,
    /// another map version, another tick, impossible abilities, a ring with contradictory head and tail, or a device
    /// that has lost its ticks.
    static std::expected<DeviceDriver, std::string> attach(RegisterWindow window, std::int64_t tick_ns);

    /// The device takes the setup when it is at rest, and its motor is enabled. No run begins before the first one.
    /// Error, which changes nothing: the setup is beyond the abilities.
    std::expected<void, std::string> set_up(const DeviceSetup& setup);

    /// Returns one consistent reading without waiting. While the device is in the middle of an update, it returns the
    /// previous reading. Error if that lasts for more than kMaxStaleReads reads, if there is no previous reading, or if
    /// the registers are impossible or no longer those of a device, or if the device has lost its ticks. If a device
    /// stops between updates, `now` stands still. Each call is a beat: it shows the device that its host lives.
    std::expected<DeviceStatus, std::string> read();
    static constexpr int kMaxStaleReads = 1000;
    /// The last read() returned the previous reading.
    bool is_stale() const { return stale_reads_ > 0; }

    /// Errors, which change nothing: a frame that does not fit into the ring, has no body, has a piece that is too
    /// long, or precedes any run; a run number that is 0 or not new; outputs that do not fit into their ring.
    std::expected<void, std::string> apply(const DeviceOrder& order);

    /// Passes every step made since the last call to on_step, in order, and returns their number. Error: a
    /// contradictory head and tail, or ticks that do not rise.
    std::expected<std::uint64_t, std::string> drain_capture(const std::function<void(StepEdge)>& on_step);
    /// Passes every event of an input or output since the last call to on_event, in order, and returns their number.
    /// Error: a contradictory head and tail, an unknown event, or ticks that fall.
    std::expected<std::uint64_t, std::string> drain_events(const std::function<void(const ChannelEvent&)>& on_event);
    /// Number of events since the device's power-up that found the event ring full.
    std::uint64_t lost_events() const { return window_.load(registers::kEventLost); }
    /// The device's abilities, as read when the driver attached.
    const DeviceAbilities& abilities() const { return abilities_; }
    /// Number of steps since the device's power-up that were made while the capture ring was full.
    std::uint64_t lost_captures() const { return window_.load(registers::kCaptureLost); }

private:
    using Result = std::expected<void, std::string>;
    DeviceDriver(RegisterWindow window, std::int64_t tick_ns, const DeviceAbilities& abilities);

    Result apply_one(const device::BeginRun& order);
    Result apply_one(const device::LoadFrame& order);
    Result apply_one(const device::LoadOutputs& order);
    Result apply_one(const device::ChangeOutputs& order);
    Result apply_one(const device::Arm& order);
    Result apply_one(const device::Veto& order);
    Result apply_one(const device::StopNow& order);
    std::expected<DeviceStatus, std::string> stale_look();
    std::expected<std::uint64_t, std::string> segments() const;
    std::expected<std::uint64_t, std::string> captures() const;
    std::expected<std::uint64_t, std::string> changes() const;
    std::expected<std::uint64_t, std::string> events() const;
    DeviceStatus read_words() const;
    std::uint64_t trigger_word(const device::BeginRun& order) const;
    std::int64_t signed_word(std::size_t offset) const { return static_cast<std::int64_t>(window_.load(offset)); }

    RegisterWindow window_;
    std::int64_t tick_ns_;
    DeviceAbilities abilities_;
    RegisterRing segment_ring_;
    RegisterRing capture_ring_;
    RegisterRing output_ring_;
    RegisterRing event_ring_;
    std::uint64_t beat_ = 0;
    std::optional<DeviceStatus> last_look_;
    std::optional<Tick> last_step_;
    std::optional<Tick> last_event_;
    int stale_reads_ = 0;
};

}  // namespace lockstep
