// Inputs of a device: each follows its pin once the pin has kept its level for a while.
#pragma once

#include <cstdint>

#include "sim_fpga/firmware/device/due.hpp"
#include "sim_fpga/firmware/device/setup.hpp"

namespace lockstep::firmware {

class Inputs {
public:
    /// Returns the inputs that change at once, because their level has another meaning from now on.
    std::uint32_t set(const Setup& setup);
    /// pins: their levels after tick `now`; pin n is bit n. Returns the inputs that change at this tick.
    std::uint32_t look(std::uint32_t pins, std::int64_t now);
    /// The tick at which an input changes if its pin keeps its level.
    Due next() const;
    std::uint32_t closed() const { return closed_; }

private:
    std::uint32_t inverted_ = 0;
    std::int64_t debounce_[kMostInputs]{};
    std::int64_t since_[kMostInputs]{};  // of the pending ones: when the pin changed
    std::uint32_t closed_ = 0;
    std::uint32_t pending_ = 0;  // the pin has another level than the input
};

}  // namespace lockstep::firmware
