// The board's analog outputs in the emulator: each period of a pin shows the value of the tick with which it begins.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "tests/simulation/board/board_fixture.hpp"

namespace lockstep::testing {
namespace {

constexpr std::array<std::uint8_t, 2> kPwmPins{5, 9};  // of motors 0 and 1
constexpr std::int64_t kFull = std::int64_t{1} << 62;
constexpr double kMachineCycle = 8;  // 40 ns

/// A pulse of a pin.
struct Pulse {
    Tick begin;         // the tick with which its period begins
    std::int64_t high;  // cycles of the machine
};

class PwmBoard : public Board {
protected:
    /// The pulses so far. A period's first three cycles are low, and the second block starts up to 100 ns late.
    std::vector<Pulse> pulses(std::uint8_t pin) {
        std::vector<Pulse> found;
        const std::vector<PinEdge>& edges = bench.edges(pin);
        for (std::size_t n = 0; n + 1 < edges.size(); ++n) {
            if (!edges[n].is_high) { continue; }
            const double since = edges[n].cycle - bench.start() - 3 * kMachineCycle;
            const double tick = std::floor(since / kCyclesPerTick);
            EXPECT_LE(since - tick * kCyclesPerTick, 20) << "behind its tick, in cycles of 5 ns";
            const double high = (edges[n + 1].cycle - edges[n].cycle) / kMachineCycle;
            EXPECT_EQ(high, std::floor(high));
            found.push_back({Tick{static_cast<std::int64_t>(tick) - kLeastStep}, static_cast<std::int64_t>(high)});
        }
        return found;
    }
    DeviceSetup with_period(std::int64_t ns) const {
        DeviceSetup setup;
        setup.pwm_period_ns[0] = ns;
        setup.at_cut.analog_off = setup.at_silence.analog_off = 1;
        return setup;
    }
};

/// The value of an output at this tick: of its newest change.
std::int64_t value_at(const std::vector<std::pair<Tick, RampAnalog>>& changes, Tick now) {
    std::int64_t value = 0;
    for (const auto& [since, ramp] : changes) {
        if (since <= now) { value = std::clamp(ramp.value + ramp.slope * (now - since).value, std::int64_t{0}, kFull); }
    }
    return value;
}

/// The nearest whole number of cycles.
std::int64_t cycles_of(std::int64_t value, std::int64_t period) {
    return std::llround(std::ldexp(static_cast<double>(value), -62) * static_cast<double>(period));
}

/// Two motors, each with its own period. The ramps rise, fall, and stay; one of them meets full scale.
TEST_F(PwmBoard, ShowsTheValueOfTheTickWithWhichAPeriodBegins) {
    constexpr std::array<std::int64_t, 2> kPeriods{50, 64};  // ticks
    const Tick start = soon();
    const std::vector<OutputChange> ramps{{Ticks{100}, RampAnalog{0, kFull / 10, kFull / 10'000}},
                                          {Ticks{3000}, RampAnalog{0, kFull / 2, -kFull / 20'000}},
                                          {Ticks{7000}, RampAnalog{0, kFull / 4, 0}},
                                          {Ticks{9000}, RampAnalog{0, kFull / 2, kFull / 1000}}};
    OutputTrack outputs;
    std::vector<std::pair<Tick, RampAnalog>> changes;
    for (const OutputChange& change : ramps) {
        outputs.body.append(change);
        changes.emplace_back(start + change.at, std::get<RampAnalog>(change.what));
    }
    for (std::size_t motor = 0; motor < kPwmPins.size(); ++motor) {
        const Course way = long_way(start, Ticks{12'000});
        order(motor, way, with_period(kPeriods[motor] * 1000));
        ASSERT_TRUE(drivers[motor].apply(device::LoadOutputs{1, outputs}));
    }
    for (std::size_t motor = 0; motor < kPwmPins.size(); ++motor) { run_to_end(motor); }
    for (std::size_t motor = 0; motor < kPwmPins.size(); ++motor) {
        const std::int64_t period = kPeriods[motor] * 25;
        const std::vector<Pulse> shown = pulses(kPwmPins[motor]);
        ASSERT_GT(std::ssize(shown), 8000 / kPeriods[motor]);
        for (std::size_t n = 0; n < shown.size(); ++n) {
            const Pulse& pulse = shown[n];
            if (pulse.begin > start + Ticks{9500}) { break; }
            const std::int64_t asked = cycles_of(value_at(changes, pulse.begin), period);
            EXPECT_LE(std::abs(pulse.high - asked), 1) << pulse.high << " cycles, not " << asked;
            if (n > 0) { EXPECT_EQ((pulse.begin - shown[n - 1].begin).value % kPeriods[motor], 0); }
        }
        EXPECT_TRUE(bench.edges(kPwmPins[motor]).back().is_high) << "full scale has no pause";
    }
}

TEST_F(PwmBoard, SwitchesAnOutputOffIfTheHostIsSilent) {
    DeviceSetup setup = with_period(40'000);
    setup.silence = Ticks{20'000};
    ASSERT_TRUE(drivers[0].set_up(setup));
    ASSERT_TRUE(drivers[0].apply(device::ChangeOutputs{{}, {{0, kFull / 2}}}));
    run(bench.now_us() + 60'000);
    const std::vector<Pulse> shown = pulses(kPwmPins[0]);
    ASSERT_GT(shown.size(), 400U);
    EXPECT_EQ(shown.back().high, 500);
    EXPECT_NEAR(static_cast<double>((shown.back().begin - shown.front().begin).value), 20'000, 2000);
}

TEST_F(PwmBoard, RefusesPeriodsThatItCannotMake) {
    EXPECT_FALSE(drivers[0].set_up(with_period(2'000'001)));
    EXPECT_TRUE(drivers[0].set_up(with_period(2'000'000)));
    EXPECT_FALSE(drivers[2].set_up(with_period(50'000))) << "motor 2 has no analog output";
}

}  // namespace
}  // namespace lockstep::testing
