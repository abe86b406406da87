// The contacts that bounce and the spindles at the pins of a simulated device.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/hardware/output_change.hpp"
#include "sim_fpga/wiring/bouncing_pins.hpp"
#include "sim_fpga/wiring/spindle.hpp"

namespace lockstep {

class Wiring {
public:
    void bounce(unsigned pin, Ticks lasts) { bouncing_.bounce(pin, lasts); }
    void connect(const SpindleConfig& spindle) { spindles_.emplace_back(spindle); }
    const std::vector<Spindle>& spindles() const { return spindles_; }

    /// The levels of the pins after tick `now`, by those of the motor's contacts and of others.
    std::uint32_t look(std::uint32_t levels, Tick now) {
        for (const Spindle& spindle : spindles_) {
            const std::uint32_t bit = std::uint32_t{1} << spindle.config().input;
            if (spindle.has_speed(now)) { levels = spindle.config().active_low ? levels & ~bit : levels | bit; }
        }
        return bouncing_.look(levels, now);
    }
    /// The outputs after tick `now`: `digital` has a bit for each; `analog_of(channel)` is from 0 to kFullScale.
    template <typename AnalogOf>
    void follow(std::uint16_t digital, AnalogOf&& analog_of, Tick now) {
        for (Spindle& spindle : spindles_) {
            const SpindleConfig& config = spindle.config();
            const double asked = config.is_analog
                                     ? static_cast<double>(analog_of(config.output)) / static_cast<double>(kFullScale)
                                     : static_cast<double>(digital >> config.output & 1);
            spindle.drive(asked, now);
        }
    }
    /// The next tick at which a pin may change by itself; nullopt: none will.
    std::optional<Tick> next(Tick now) const {
        std::optional<Tick> first = bouncing_.next();
        for (const Spindle& spindle : spindles_) {
            const auto at = spindle.next(now);
            if (at) { first = std::min(first.value_or(*at), *at); }
        }
        return first;
    }

private:
    BouncingPins bouncing_;
    std::vector<Spindle> spindles_;
};

}  // namespace lockstep
