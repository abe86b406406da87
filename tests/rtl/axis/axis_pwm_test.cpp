// sim_fpga/rtl/axis/axis_pwm.v: for how many clocks of each period its pin is on.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>

#include "Vaxis_pwm.h"
#include "tests/rtl/clocked.hpp"

namespace lockstep::rtl {
namespace {

/// The clocks of a period in which the pin is on, after two periods in which the hardware takes over period and level.
std::int64_t on_clocks(Clocked<Vaxis_pwm>& pwm, std::int64_t period, std::int64_t level) {
    pwm.pins.period = static_cast<std::uint16_t>(period);
    pwm.pins.level = static_cast<std::uint16_t>(level);
    for (std::int64_t clock = 0; clock < 3 * period + 65'536; ++clock) { pwm.clock(); }
    std::int64_t on = 0;
    for (std::int64_t clock = 0; clock < period; ++clock) {
        pwm.clock();
        on += pwm.pins.pin;
    }
    return on;
}

TEST(AxisPwm, IsOnForTheLevelsPartOfEachPeriod) {
    Clocked<Vaxis_pwm> pwm;
    constexpr std::int64_t kFull = 1 << 15;
    std::mt19937_64 random(7);
    for (int n = 0; n < 30; ++n) {
        const auto period = static_cast<std::int64_t>(18 + random() % (n % 2 == 0 ? 100 : 5'000));
        const auto level = static_cast<std::int64_t>(random() % (kFull + 1));
        EXPECT_EQ(on_clocks(pwm, period, level), period * level / kFull) << period << " clocks, level " << level;
    }
    EXPECT_EQ(on_clocks(pwm, 1'000, kFull), 1'000);
    EXPECT_EQ(on_clocks(pwm, 1'000, 0), 0);
    EXPECT_EQ(on_clocks(pwm, 0, kFull), 0);
}

}  // namespace
}  // namespace lockstep::rtl
