// Clocks of separate boards, for machines in virtual time.
#pragma once

#include "services/virtual/virtual_machine.hpp"

namespace lockstep::test {

/// Offsets of seconds and rates up to 100 ppm fast and slow, different for devices and processes.
inline std::vector<AxisClocks> clocks_apart() {
    return {{.process = {.offset = {3'000'000}, .ppm = 100}, .device = {.offset = {77'000'000}, .ppm = -80}},
            {.process = {.offset = {-1'500'000}, .ppm = -100}, .device = {.offset = {-400}, .ppm = 100}}};
}

}  // namespace lockstep::test
