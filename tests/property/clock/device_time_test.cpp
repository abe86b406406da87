// Frames on a device's own clock: they keep machine time within the reported error, without exceeding speed limits.
#include "core/axis/device_time.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>
#include <optional>
#include <random>

#include "tests/property/clock/two_clocks.hpp"

namespace lockstep {
namespace {

constexpr double kDeviceDrift = 80e-6;  // against this process's clock

Tick device_shows(Tick own) {
    return Tick{12'345} + Ticks{std::llround(static_cast<double>(own.value) * (1 + kDeviceDrift))};
}

/// The clock of a device whose registers take no time to read.
DeviceClocks::Device shown_at_once(Tick own, Tick shown) {
    return {DeviceClock::Own, ClockExchange{own, shown, shown, own}};
}

/// 25 mm/s at 400 steps/mm, reached in 83 ms.
AxisConfig screw() {
    return {.name = "Z",
            .steps_per_mm = 400,
            .start_velocity_mm_s = 4,
            .max_velocity_mm_s = 25,
            .max_accel_mm_s2 = 300,
            .max_decel_mm_s2 = 300};
}

/// Frames that follow each other on one machine; each is loaded while the previous one runs.
class LoadedFrames {
public:
    explicit LoadedFrames(std::uint64_t seed) : clocks_(seed) {
        machine_.timing.time_source = TimeSource::Network;
        machine_.axes = {screw()};
        time_.emplace(MotorIndex{0}, machine_);
    }

    void begin() {
        for (int i = 0; i < 20; ++i) { look(false); }
        (void)time_->in_device_time(device::BeginRun{});
        start_ = time_->clocks().now() + Ticks{300'000};
    }

    /// Loads a frame of any length and returns the device's track.
    ExecutedTrack load() {
        look(true);
        while (time_->clocks().now() < start_ - Ticks{300'000}) { look(true); }
        const Ticks ticks{std::llround(std::exp(clocks_.real(std::log(50.0), std::log(200'000.0))))};
        device::LoadFrame frame{.number = ++number_, .start = start_};
        (void)frame.track.body.push_back({ticks, {1 << 20}, {}});
        (void)time_->in_device_time(frame);
        ExecutedTrack track{.epoch = 1, .frame = number_, .start = start_};
        track.pieces.assign(1, {ticks, {1 << 20}, {}});
        start_ += ticks;
        return time_->in_device_time(track);
    }

    /// Loads the long tail of one more frame and returns the device's track.
    ExecutedTrack come_to_rest() {
        const Ticks body{50'000};
        const Ticks tail{12'000'000};
        device::LoadFrame frame{.number = ++number_, .start = start_};
        (void)frame.track.body.push_back({body, {1 << 20}, {}});
        (void)frame.track.tail.push_back({tail, {1 << 20}, {}});
        (void)time_->in_device_time(frame);
        ExecutedTrack track{.epoch = 1, .frame = number_, .tail = true, .start = start_ + body};
        track.pieces.assign(1, {tail, {1 << 20}, {}});
        return time_->in_device_time(track);
    }

    double drift() const { return clocks_.drift(); }
    /// The time of the device's clock at a machine time.
    Tick device_at(Tick machine) const { return device_shows(clocks_.own(static_cast<double>(machine.value))); }

private:
    void look(bool in_use) {
        time_->clocks().take(clocks_.exchange());
        const Tick own = clocks_.own(clocks_.truth());
        (void)time_->clocks().look(own, shown_at_once(own, device_shows(own)), in_use);
    }

    MachineConfig machine_;
    TwoClocks clocks_;
    std::optional<DeviceTime> time_;
    FrameNumber number_ = 0;
    Tick start_;
};

/// Two faults at once. When the device continues, its clock no longer shows by how much this process's clock was set.
/// Exchanges with the coordinator have shown that before.
TEST(DeviceTime, IsRightAgainAfterTheClockWasSetBackWhileTheDeviceStoodStill) {
    constexpr Ticks kLoop{500};
    MachineConfig machine;
    machine.timing.time_source = TimeSource::Network;
    machine.axes = {screw()};
    DeviceTime time(MotorIndex{0}, machine);
    Tick now;  // machine time
    Ticks own_ahead{4'000'000};
    Tick shown{12'345};
    int loops = 0;
    const auto look = [&](bool stands_still) {
        now += kLoop;
        if (!stands_still) { shown += kLoop; }
        const Tick own = now + own_ahead;
        if (++loops % 5 == 0) { time.clocks().take({own - Ticks{200}, now - Ticks{100}, now - Ticks{100}, own}); }
        return time.clocks().look(own, shown_at_once(own, shown), true);
    };
    for (int i = 0; i < 2000; ++i) { look(false); }
    ASSERT_LE(std::abs((time.clocks().now() - now).value), time.error().value);
    EXPECT_LE(std::abs((time.in_machine_time({.now = shown}).now - now).value), time.error().value);
    own_ahead = own_ahead - Ticks{7'251'060};
    EXPECT_FALSE(look(false));
    for (int i = 0; i < 28; ++i) { EXPECT_TRUE(look(true)) << "its axis is not silent"; }
    for (int i = 0; i < 2000; ++i) { look(false); }
    EXPECT_LE(std::abs((time.clocks().now() - now).value), time.error().value);
    EXPECT_LE(time.error(), Ticks{1'000});
}

TEST(DeviceTime, AFrameIsWithinTheReportedErrorForAnyClocks) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        LoadedFrames frames(seed);
        frames.begin();
        for (int i = 0; i < 60; ++i) {
            const ExecutedTrack track = frames.load();
            const Ticks off = track.start - frames.device_at(track.commanded_start);
            ASSERT_LE(std::abs(off.value), track.clock_error.value + 2) << "seed " << seed << ", frame " << i;
        }
    }
}

TEST(DeviceTime, TheEndOfALongTailIsWithinTheReportedError) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        LoadedFrames frames(seed);
        frames.begin();
        const ExecutedTrack tail = frames.come_to_rest();
        const Ticks lasts = std::accumulate(tail.commanded_ticks.begin(), tail.commanded_ticks.end(), Ticks{});
        const Ticks off = tail.start + total_ticks(tail.pieces) - frames.device_at(tail.commanded_start + lasts);
        ASSERT_LE(std::abs(off.value), tail.clock_error.value + 2) << "seed " << seed;
        ASSERT_LE(tail.clock_error.value, 10'000) << "12 s: the error of the rate, and no more";
    }
}

TEST(DeviceTime, OfClocksThatGoAlikeTheRateIsNoneAndTheyPassTheSameTime) {
    constexpr Ticks kAhead{12'345};  // the device's clock
    MachineConfig machine;
    machine.timing.time_source = TimeSource::Network;
    machine.axes = {screw()};
    DeviceTime time(MotorIndex{0}, machine);
    for (Tick now{500}; now < Tick{1'000'000}; now += Ticks{500}) {
        time.clocks().take({now - Ticks{200}, now - Ticks{100}, now - Ticks{100}, now});
        (void)time.clocks().look(now, shown_at_once(now, now + kAhead), true);
    }
    EXPECT_NEAR(time.clocks().device_clock().rate, 0, 2 * ClockEstimator::kMaxRate);
    const auto machine_at = [&](Ticks after) {
        return time.in_machine_time({.now = Tick{1'000'000} + kAhead + after}).now;
    };
    EXPECT_NEAR(static_cast<double>((machine_at(Ticks{300}) - machine_at(Ticks{})).value), 300, 1);
}

TEST(DeviceTime, AShortFrameIsNotAcceleratedToCorrectALongOne) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        LoadedFrames frames(seed);
        frames.begin();
        for (int i = 0; i < 60; ++i) {
            const ExecutedTrack track = frames.load();
            ASSERT_EQ(track.commanded_ticks.size(), 1U);
            const auto commanded = static_cast<double>(track.commanded_ticks[0].value);
            const double by_clocks = commanded * (1 + frames.drift()) * (1 + kDeviceDrift);
            const double most = commanded * (MachineTime::kMaxSlew + ClockEstimator::kMaxRate) + 2;
            ASSERT_NEAR(static_cast<double>(total_ticks(track.pieces).value), by_clocks, most)
                << "seed " << seed << ", frame " << i;
        }
    }
}

/// A device that answers late, on the host whose clock is machine time.
class LateAnswers {
public:
    explicit LateAnswers(std::uint64_t seed, TimeSource source = TimeSource::Shared) : random_(seed) {
        machine_.timing.time_source = source;
        machine_.axes = {screw()};
        machine_.axes[0].device = {DeviceName::Kind::Mapped, "/dev/late"};
        time_.emplace(MotorIndex{0}, machine_);
    }

    /// Asks, and gets the answer after 0.1 to 5 ms, in which the loop runs without one. Returns whether the answer
    /// leaves no doubt.
    bool exchange(bool in_use = true) {
        const Tick asked = own();
        now_ += Ticks{draw(50, 2500)};
        const Tick shown = device_at(now_);
        if (draw(0, 1) == 1) { (void)time_->clocks().look(own(), no_answer(), true); }
        now_ += Ticks{draw(50, 2500)};
        return time_->clocks().look(
            own(), DeviceClocks::Device{DeviceClock::Own, ClockExchange{asked, shown, shown, own()}}, in_use);
    }
    bool pass(Ticks time) {
        now_ += time;
        return time_->clocks().look(own(), no_answer(), true);
    }
    void ask_coordinator() { time_->clocks().take({own() - Ticks{200}, now_ - Ticks{100}, now_ - Ticks{100}, own()}); }
    void set_own(Ticks forward) { ahead_ += forward; }

    const DeviceTime& time() const { return *time_; }
    Tick now() const { return now_; }
    /// The error of what the device shows now, converted to machine time.
    Ticks off() const { return length_of(time_->in_machine_time({.now = device_at(now_)}).now - now_); }

private:
    static DeviceClocks::Device no_answer() { return {DeviceClock::Own, std::nullopt}; }
    static Tick device_at(Tick truth) { return device_shows(truth); }
    Tick own() const { return now_ + ahead_; }
    std::int64_t draw(std::int64_t least, std::int64_t most) {
        return std::uniform_int_distribution(least, most)(random_);
    }

    std::mt19937_64 random_;
    MachineConfig machine_;
    std::optional<DeviceTime> time_;
    Tick now_{1'000'000};  // machine time
    Ticks ahead_;          // this process's clock
};

TEST(DeviceTime, ADeviceThatAnswersLateIsWithinTheReportedError) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        LateAnswers late(seed);
        for (int i = 0; i < 3000; ++i) {
            ASSERT_TRUE(late.exchange());
            ASSERT_EQ(late.time().clocks().now(), late.now()) << "machine time is the host's clock";
            ASSERT_LE(late.off(), late.time().error()) << "seed " << seed << ", answer " << i;
        }
        EXPECT_GE(late.time().error(), Ticks{50}) << "half the shortest way there and back";
        EXPECT_LE(late.time().error(), Ticks{400});
    }
}

TEST(DeviceTime, TheReportedErrorGrowsWithTheAgeOfAReading) {
    LateAnswers late(1);
    for (int i = 0; i < 3000; ++i) { (void)late.exchange(); }
    const Ticks fresh = late.time().error();
    EXPECT_TRUE(late.pass(Ticks{60'000'000}));
    EXPECT_GT(late.time().error(), fresh + Ticks{60}) << "1 ppm at least";
    EXPECT_LE(late.off(), late.time().error());
}

TEST(DeviceTime, NothingIsKnownOfADeviceBeforeItsFirstAnswer) {
    LateAnswers late(1);
    EXPECT_FALSE(late.pass(Ticks{1000}));
    EXPECT_TRUE(late.exchange());
}

/// Between the two answers that prove it, this process's clock was wrong, and machine time went with it. The reported
/// error covers that until time has caught up.
TEST(DeviceTime, LateAnswersShowByHowMuchThisProcessesClockWasSet) {
    for (const Ticks by : {Ticks{7'251'060}, Ticks{-7'251'060}, Ticks{40'000}}) {
        LateAnswers late(3, TimeSource::Network);
        for (int i = 0; i < 3000; ++i) {
            if (i % 10 == 0) { late.ask_coordinator(); }
            (void)late.exchange();
        }
        late.set_own(by);
        int doubts = 0;
        while (!late.exchange()) { ++doubts; }
        EXPECT_EQ(doubts, 1);
        EXPECT_LE(length_of(late.time().clocks().now() - late.now()), late.time().error()) << by.value;
        for (int i = 0; i < 100; ++i) {
            (void)late.exchange(false);
            EXPECT_LE(length_of(late.time().clocks().now() - late.now()), late.time().error()) << by.value;
        }
    }
}

}  // namespace
}  // namespace lockstep
