// A reading of a device: its status, and the time at which this status was true.
#pragma once

#include <cstdint>

#include "core/axis/device/device.hpp"
#include "core/clock/clock_estimator.hpp"

namespace lockstep {

/// The clock whose ticks a device counts.
enum class DeviceClock : std::uint8_t {
    Host,  // that of the axis's process; the device may show its ticks late
    Own,   // an oscillator of the device
};

/// A status, and when it was true: at an instant of the interval from `asked` to `answered`, by the process's clock. If
/// the device counts the host's clock, `status.now` is this instant. If it has a clock of its own, this instant is that
/// of the tick at its pins, which is `behind` the last tick that it executed. So motors of different devices step
/// together at their pins.
struct DeviceReading {
    DeviceStatus status;
    Tick asked;
    Tick answered;
    Ticks behind{};
};

/// The same as an exchange with the device's clock, of which a reading shows one tick.
inline ClockExchange exchange_of(const DeviceReading& reading) {
    const Tick at_pins = reading.status.now - reading.behind;
    return {reading.asked, at_pins, at_pins, reading.answered};
}

}  // namespace lockstep
