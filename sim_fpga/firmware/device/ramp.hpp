// The value of an analog output, which changes by its slope with each tick.
#pragma once

#include <cstdint>

#include "sim_fpga/firmware/device/wide.hpp"

namespace lockstep::firmware {

/// Full scale of an analog output. Its value is a whole number of 2^-62 of this.
inline constexpr std::int64_t kFullScale = std::int64_t{1} << 62;

constexpr std::int64_t within_scale(std::int64_t value) {
    if (value < 0) { return 0; }
    return value < kFullScale ? value : kFullScale;
}

struct Ramp {
    std::int64_t value = 0;
    std::int64_t slope = 0;  // for each tick
    std::int64_t since = 0;

    /// After tick `now`, which is not before `since`. It stays at 0 or full scale when it gets there.
    constexpr std::int64_t at(std::int64_t now) const {
        if (slope == 0) { return value; }
        const Wide sum = widened(value) + product_of(slope, now - since);
        if (is_negative(sum)) { return 0; }
        return is_narrow(sum) ? within_scale(static_cast<std::int64_t>(sum.low)) : kFullScale;
    }
};

}  // namespace lockstep::firmware
