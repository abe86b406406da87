// The bound holds and is narrow with offsets of seconds, rates 100 ppm apart, different delays each way, and losses.
#include "core/clock/clock_estimator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/property/clock/two_clocks.hpp"

namespace lockstep {
namespace {

void expect_within_bound(const ClockEstimator& estimator, const TwoClocks& clocks, double truth, std::uint64_t seed) {
    const auto [other, error] = estimator.at(clocks.own(truth));
    ASSERT_LE(std::abs((other - TwoClocks::coordinator(truth)).value), error.value) << "seed " << seed;
}

TEST(ClockEstimator, TheTrueErrorNeverExceedsTheBound) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        TwoClocks clocks(seed);
        ClockEstimator estimator(kTick_ns);
        for (int i = 0; i < 400; ++i) {
            estimator.take(clocks.exchange());
            for (const double later : {0.0, 10e3, 1e6, 30e6}) {
                ASSERT_NO_FATAL_FAILURE(expect_within_bound(estimator, clocks, clocks.truth() + later, seed));
            }
        }
        EXPECT_EQ(estimator.steps(), 0u);
    }
}

TEST(ClockEstimator, TheBoundComesToHalfTheLeastRoundTrip) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        TwoClocks clocks(seed);
        ClockEstimator estimator(kTick_ns);
        std::int64_t least = INT64_MAX;
        for (int i = 0; i < 120; ++i) {
            const ClockExchange e = clocks.exchange();
            least = std::min(least, ((e.arrived - e.sent) - (e.answered - e.received)).value);
            estimator.take(e);
        }
        const std::int64_t error = estimator.at(clocks.own(clocks.truth())).error.value;
        EXPECT_LE(error, least / 2 + least / 8 + 60) << "seed " << seed;
    }
}

TEST(ClockEstimator, ADoubtThatIsRefutedIsForgotten) {
    ClockEstimator doubted(kTick_ns);
    Tick now{1000};
    const auto exchange = [&](Ticks ahead) {
        const Tick other = now - Ticks{50} + ahead;
        return ClockExchange{now - Ticks{100}, other, other, now};
    };
    for (int i = 0; i < 20; ++i, now += Ticks{1000}) { doubted.take(exchange({})); }
    EXPECT_EQ(doubted.offer(exchange(Ticks{5000})), ClockEstimator::Finding::Doubtful);
    now += Ticks{1000};
    doubted.take(exchange({}));
    ClockEstimator fresh(kTick_ns);
    fresh.take(exchange({}));
    EXPECT_LE(doubted.at(now).error, fresh.at(now).error);
}

TEST(ClockEstimator, TheRateIsFound) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        TwoClocks clocks(seed);
        ClockEstimator estimator(kTick_ns);
        for (int i = 0; i < 200; ++i) { estimator.take(clocks.exchange()); }
        EXPECT_NEAR(estimator.rate(), -clocks.drift(), 1e-4) << "seed " << seed;
    }
}

TEST(ClockEstimator, OneExchangeTellsNothingOfTheRate) {
    for (std::int64_t round_trip = 1; round_trip < 5'000; ++round_trip) {
        ClockEstimator estimator(kTick_ns);
        const Tick sent{1'000'000};
        estimator.take({sent, sent, sent, sent + Ticks{round_trip}});
        ASSERT_EQ(estimator.rate(), 0) << round_trip;
    }
}

TEST(ClockEstimator, WithoutExchangesTheBoundGrowsWithThePossibleDrift) {
    TwoClocks clocks(7);
    ClockEstimator estimator(kTick_ns);
    for (int i = 0; i < 200; ++i) { estimator.take(clocks.exchange()); }
    const Tick now = clocks.own(clocks.truth());
    const Ticks hour{3'600'000'000};
    const std::int64_t grown = (estimator.at(now + hour).error - estimator.at(now).error).value;
    EXPECT_GT(grown, 3'600);
    EXPECT_LE(grown, 2 * 720'000);
}

TEST(ClockEstimator, AClockThatIsSetWidensTheBoundUntilASecondExchangeConfirmsIt) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        TwoClocks clocks(seed);
        ClockEstimator estimator(kTick_ns);
        for (int i = 0; i < 100; ++i) { estimator.take(clocks.exchange()); }
        const double step = (seed % 2 == 0 ? 1 : -1) * clocks.real(20e3, 3e6);
        clocks.step(step);
        for (int i = 0; i < 200; ++i) {
            estimator.take(clocks.exchange());
            if (i == 0) { EXPECT_GE(estimator.at(clocks.own(clocks.truth())).error.value, std::abs(step) / 2); }
            ASSERT_NO_FATAL_FAILURE(expect_within_bound(estimator, clocks, clocks.truth(), seed));
        }
        EXPECT_EQ(estimator.steps(), 1u) << "seed " << seed;
        EXPECT_LT(estimator.at(clocks.own(clocks.truth())).error.value, 3000) << "seed " << seed;
    }
}

TEST(ClockEstimator, IgnoresAnImpossibleExchange) {
    ClockEstimator estimator(kTick_ns);
    estimator.take({.sent = {100}, .received = {500}, .answered = {499}, .arrived = {110}});
    estimator.take({.sent = {100}, .received = {500}, .answered = {501}, .arrived = {90}});
    EXPECT_FALSE(estimator.known());
}

}  // namespace
}  // namespace lockstep
