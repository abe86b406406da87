// sim_fpga/rtl/motors/motors_device.v beside sim_fpga/device.hpp: the devices of several motors get the same words from
// hosts that draw them, and must show the same words after every tick.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "Vmotors_device_1.h"
#include "Vmotors_device_2.h"
#include "Vmotors_device_3.h"
#include "Vmotors_device_6.h"
#include "tests/rtl/axis/coverage.hpp"
#include "tests/rtl/axis/drawn_host.hpp"
#include "tests/rtl/axis/one_frame.hpp"
#include "tests/rtl/motors/bench.hpp"

namespace lockstep::rtl {
namespace {

template <typename M, std::size_t kN>
struct Motors {
    using Module = M;
    static constexpr std::size_t kMotors = kN;
};
using Numbers = ::testing::Types<Motors<Vmotors_device_1, 1>, Motors<Vmotors_device_3, 3>, Motors<Vmotors_device_6, 6>>;

template <typename T>
class MotorsHardware : public ::testing::Test {};
TYPED_TEST_SUITE(MotorsHardware, Numbers);

/// Compares until all motors together have got so many pieces. Returns what they went through.
template <typename Module, std::size_t kMotors>
Coverage compare_for(std::int64_t wanted) {
    using Bench = MotorsBench<Module, kMotors>;
    Bench bench;
    std::vector<DrawnHost<typename Bench::Motor>> hosts;
    for (std::size_t n = 0; n < kMotors; ++n) { hosts.emplace_back(bench.motor(n), 4 + n); }
    std::array<Coverage, kMotors> covered;
    for (std::int64_t pieces = 0; pieces < wanted && !::testing::Test::HasFailure();) {
        pieces = 0;
        for (auto& host : hosts) {
            host.act();
            pieces += host.pieces();
        }
        bench.tick();
        for (std::size_t n = 0; n < kMotors; ++n) { covered[n].note(bench.motor(n)); }
    }
    Coverage all;
    for (const Coverage& one : covered) { all += one; }
    return all;
}

TYPED_TEST(MotorsHardware, ShowsTheWordsOfTheSimulatedDevicesAfterEveryTickForAnyHosts) {
    const Coverage all = compare_for<typename TypeParam::Module, TypeParam::kMotors>(wanted_pieces() / 5);
    EXPECT_GT(all.joins(), 100);
}

/// Two motors.
class TwoMotors : public ::testing::Test {
protected:
    using Hardware = VerilogMotors<Vmotors_device_2, 2>;
    static constexpr std::uint64_t kQuarter = std::uint64_t{1} << 62;  // of a step in each tick

    void run_frame(std::size_t motor, std::uint64_t ticks, std::uint64_t velocity, std::uint64_t acceleration) {
        run_one_frame([&](std::size_t offset, std::uint64_t value) { hardware_.write(motor, offset, value); }, 2, ticks,
                      velocity, acceleration);
    }
    /// Returns the steps that each motor made.
    std::array<int, 2> run_ticks(int ticks) {
        std::array<int, 2> steps{};
        for (; ticks > 0; --ticks) {
            hardware_.tick({}, [&](std::size_t motor, int direction) {
                steps[motor] += direction;
                return Hardware::Levels{};
            });
        }
        return steps;
    }
    std::uint64_t shown(std::size_t motor, std::size_t offset) {
        hardware_.show(motor);
        return hardware_.read(motor, offset);
    }

    Hardware hardware_;
};

TEST_F(TwoMotors, GoThroughAllThatHostsDo) { compare_for<Vmotors_device_2, 2>(wanted_pieces()).expect_all(); }

/// The simulated device refuses such a frame when it should begin.
TEST_F(TwoMotors, EndTheRunInTheTickInWhichTheVelocityLeaves64Bits) {
    using namespace registers;
    run_frame(1, 100, 0, std::uint64_t{1} << 61);
    EXPECT_EQ(run_ticks(20), (std::array{0, 1}));  // 1/8 + 2/8 + 3/8 of a step, and 4/8 would be the next
    EXPECT_EQ(shown(1, kStatus), kStatusFinished | kStatusBadSegment | kStatusEnabled);
    EXPECT_EQ(shown(1, kVelocity), 0);
}

/// The pins would show its step too late.
TEST_F(TwoMotors, ATickWhoseStepsAreNotMadeBeforeTheNextOneEndsTheRunsAndAllFurtherOnes) {
    using namespace registers;
    run_frame(0, 100, kQuarter, 0);
    run_frame(1, 100, kQuarter, 0);
    hardware_.begin_tick();
    EXPECT_EQ(run_ticks(1), (std::array{0, 0})) << "at rest a tick may wait";
    EXPECT_EQ(shown(0, kStatus) & kStatusLostTicks, 0);
    EXPECT_EQ(run_ticks(7), (std::array{2, 2}));
    hardware_.begin_tick();
    (void)run_ticks(1);
    for (const std::size_t motor : {0, 1}) {
        EXPECT_EQ(shown(motor, kStatus), kStatusFinished | kStatusLostTicks | kStatusEnabled);
        hardware_.write(motor, kRunRequest, 2);
    }
    EXPECT_EQ(run_ticks(20), (std::array{0, 0}));
    EXPECT_EQ(shown(1, kStatus), kStatusFinished | kStatusLostTicks | kStatusEnabled);
}

TEST_F(TwoMotors, TakeAWordBetweenTwoTicksAndAnEntryOfARingAtOnce) {
    using namespace registers;
    hardware_.begin_tick();
    hardware_.write(1, kSegmentRing + kSegmentRingHeaderStart, 0x0123'4567'89AB'CDEF);
    EXPECT_TRUE(hardware_.is_busy());
    hardware_.write(1, kArmed, 7);
    EXPECT_FALSE(hardware_.is_busy());
    EXPECT_EQ(hardware_.read(1, kSegmentRing + kSegmentRingHeaderStart), 0x0123'4567'89AB'CDEF);
    EXPECT_EQ(hardware_.read(1, kArmed), 7);
    EXPECT_EQ(hardware_.read(0, kArmed), 0);
}

TEST_F(TwoMotors, KeepTheWordsThatTheyShowUntilTheHostAsksAgain) {
    using namespace registers;
    hardware_.write(0, kPowerUp, 99);
    run_frame(0, 40, kQuarter, 0);
    (void)run_ticks(12);
    EXPECT_EQ(shown(0, kTick), 12);
    const std::uint64_t count = hardware_.read(0, kCount);
    (void)run_ticks(8);
    EXPECT_EQ(hardware_.read(0, kTick), 12);
    EXPECT_EQ(hardware_.read(0, kCount), count);
    EXPECT_EQ(shown(0, kTick), 20);
    EXPECT_EQ(hardware_.read(0, kCount), count + 2);
    EXPECT_EQ(hardware_.read(0, kMagic), kMagicValue);
    EXPECT_EQ(hardware_.read(0, kMapChecksum), kMapChecksumValue);
    EXPECT_EQ(hardware_.read(0, kPowerUp), 99);
}

}  // namespace
}  // namespace lockstep::rtl
