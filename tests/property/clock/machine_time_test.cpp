// The machine time of an axis is within its bound of the coordinator's. It never goes backwards and is never set while
// in use.
#include "core/clock/machine_time.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/property/clock/two_clocks.hpp"

namespace lockstep {
namespace {

TEST(MachineTime, IsWithinItsBound) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        TwoClocks clocks(seed);
        MachineTime time(kTick_ns, TimeSource::Network);
        for (int i = 0; i < 400; ++i) {
            time.take(clocks.exchange());
            const Tick own = clocks.own(clocks.truth());
            const Tick now = time.advance(own, i / 50 % 2 == 1);
            ASSERT_LE(std::abs((now - TwoClocks::coordinator(clocks.truth())).value), time.error(own).value)
                << "seed " << seed << ", exchange " << i;
        }
    }
}

TEST(MachineTime, NeverGoesBackwardsWhenTheUnderlyingClockIsSet) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        TwoClocks clocks(seed);
        MachineTime time(kTick_ns, TimeSource::Network);
        Tick last{INT64_MIN};
        for (int i = 0; i < 400; ++i) {
            time.take(clocks.exchange());
            if (i % 100 == 99) { clocks.step(clocks.real(-1e6, 1e6)); }
            const Tick now = time.advance(clocks.own(clocks.truth()), i / 50 % 2 == 1);
            ASSERT_GE(now, last) << "seed " << seed;
            last = now;
        }
    }
}

TEST(MachineTime, IsNotSetWhileInUse) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        TwoClocks clocks(seed);
        MachineTime time(kTick_ns, TimeSource::Network);
        time.take(clocks.exchange());
        Tick own = clocks.own(clocks.truth());
        Tick last = time.advance(own, true);
        for (int i = 0; i < 300; ++i) {
            time.take(clocks.exchange());
            const Tick next = clocks.own(clocks.truth());
            const Tick now = time.advance(next, true);
            const double passed = static_cast<double>((next - own).value);
            const double most = MachineTime::kMaxSlew + ClockEstimator::kMaxRate;
            ASSERT_NEAR(static_cast<double>((now - last).value), passed, passed * most + 2) << "seed " << seed;
            own = next;
            last = now;
        }
    }
}

TEST(MachineTime, TheOwnClockAtAMachineTimeIsTheOneThatShowsIt) {
    TwoClocks clocks(3);
    MachineTime time(kTick_ns, TimeSource::Network);
    for (int i = 0; i < 100; ++i) {
        time.take(clocks.exchange());
        const Tick now = time.advance(clocks.own(clocks.truth()), true);
        for (const std::int64_t ahead : {0, 1000, 400'000, 60'000'000}) {
            const Tick machine = now + Ticks{ahead};
            EXPECT_LE(std::abs((time.at(time.own_at(machine)) - machine).value), 1);
        }
    }
}

}  // namespace
}  // namespace lockstep
