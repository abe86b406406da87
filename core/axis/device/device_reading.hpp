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
/// the device counts the host's clock, `status.now` is this instant.
struct DeviceReading {
    DeviceStatus status;
    Tick asked;
    Tick answered;
};

/// The same as an exchange with the device's clock, of which a reading shows one tick.
inline ClockExchange exchange_of(const DeviceReading& reading) {
    return {reading.asked, reading.status.now, reading.status.now, reading.answered};
}

}  // namespace lockstep
