// Clocks of boards' own, and what their readings are in true time: a virtual machine knows it.
#pragma once

#include "services/virtual/virtual_machine.hpp"

namespace lockstep::test {

/// Offsets of seconds, rates up to 100 ppm fast and slow, devices and processes apart.
inline std::vector<AxisClocks> clocks_apart() {
    return {{.process = {.offset = {3'000'000}, .ppm = 100}, .device = {.offset = {77'000'000}, .ppm = -80}},
            {.process = {.offset = {-1'500'000}, .ppm = -100}, .device = {.offset = {-400}, .ppm = 100}}};
}

/// The true time, in ticks, at which a clock that was never set came to show `reading`.
inline double true_time(const VirtualClock& clock, Tick reading, Tick origin) {
    const double since = static_cast<double>((reading - clock.offset - origin).value);
    return static_cast<double>(origin.value) + since / (1 + clock.ppm * 1e-6);
}

}  // namespace lockstep::test
