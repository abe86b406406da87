// sim_fpga/rtl/carrica with the host that gives it moves.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "Vcarrica_controller.h"
#include "core/methods/carrica.hpp"
#include "core/units.hpp"
#include "tests/rtl/clocked.hpp"

namespace lockstep::rtl {

inline constexpr int kCarricaFraction = 40;

class CarricaMotor {
public:
    static constexpr int kLongest = 50'000'000;  // clocks of a move

    CarricaMotor() { hardware_.reset(); }

    /// Makes a move. Returns the period T_c of each step, and calls on_clock(pins) after every clock.
    template <typename OnClock>
    std::vector<std::int64_t> move(const methods::CarricaSteps::Reference& reference, std::int64_t steps,
                                   OnClock&& on_clock) {
        auto& pins = hardware_.pins;
        pins.min = static_cast<std::uint64_t>(reference.min);
        pins.max = static_cast<std::uint64_t>(reference.max);
        pins.change = static_cast<std::uint64_t>(reference.change);
        const Int128 braking =
            (Int128{reference.max} * reference.max - Int128{reference.min} * reference.min) / reference.change;
        pins.braking_at_max = static_cast<std::uint64_t>(std::min(braking, Int128{~std::uint64_t{0}}));
        pins.steps = static_cast<std::uint32_t>(steps);
        pins.start = 1;
        hardware_.clock();
        pins.start = 0;
        std::vector<std::int64_t> periods;
        std::int64_t period = 0;
        for (int clock = 0; pins.moving != 0 && clock < kLongest; ++clock) {
            hardware_.clock();
            period += pins.period;
            if (pins.step != 0) { periods.push_back(period); }
            on_clock(pins);
        }
        return periods;
    }
    Vcarrica_controller& pins() { return hardware_.pins; }

private:
    Clocked<Vcarrica_controller> hardware_;
};

/// The periods of the steps by the method.
inline std::vector<std::int64_t> carrica_periods(methods::CarricaSteps steps, std::int64_t count) {
    std::vector<std::int64_t> periods;
    for (std::int64_t i = 0; i < count; ++i) { periods.push_back(std::llround(steps.next_s() / steps.clock_s())); }
    return periods;
}

}  // namespace lockstep::rtl
