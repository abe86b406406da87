// Random moves at an axis's limits, in frames of any length, while the clock estimate changes at random: by
// the device's clock no step breaks a limit, no step is lost, and clock errors are corrected.
#include "core/axis/device/frame_pace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "core/motion/frame_limits.hpp"
#include "core/step/engine.hpp"

namespace lockstep {
namespace {

using Body = StaticVector<Piece, kMaxBodyPieces + 1>;
using Tail = StaticVector<Piece, kMaxTailPieces + 1>;

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double real(double least, double most) { return std::uniform_real_distribution(least, most)(engine_); }
    double magnitude(double least, double most) { return std::exp(real(std::log(least), std::log(most))); }
    std::int64_t ticks(double least, double most) { return std::llround(magnitude(least, most)); }
    bool chance(double probability) { return real(0, 1) < probability; }

private:
    std::mt19937_64 engine_;
};

/// A machine of one axis with steps of 1 mm.
MachineConfig random_machine(Random& random) {
    const double top = random.magnitude(300, 80'000);
    const double start = random.magnitude(std::min(30.0, top / 3), std::min(top, 3000.0));
    AxisConfig axis{.name = "X", .steps_per_mm = 1};
    axis.max_velocity_mm_s = top;
    axis.start_velocity_mm_s = start;
    axis.max_accel_mm_s2 = std::max(0.1 * top, top - start) / random.magnitude(0.005, 0.8);
    axis.max_decel_mm_s2 = axis.max_accel_mm_s2 * random.magnitude(0.4, 2.5);
    MachineConfig machine{.timing = {.time_source = TimeSource::Network}};
    machine.axes = {axis};
    return machine;
}

/// A piece from one speed to another, as short as the acceleration `most` allows.
Piece ramp(double from, double to, double most) {
    const double ticks = std::max(1.0, std::ceil(std::abs(to - from) / most));
    const double change = (to - from) / ticks;
    return {
        {std::llround(ticks)}, {std::llround((from + change / 2 - change) * 0x1p64)}, {std::llround(change * 0x1p64)}};
}

/// A move from the start velocity up to a random speed, on at this speed, and back.
std::vector<Piece> random_move(Random& random, const AxisLimits& limits) {
    const double top =
        random.chance(0.5) ? limits.max_velocity : random.real(limits.start_velocity, limits.max_velocity);
    const Piece up = ramp(limits.start_velocity, top, limits.max_acceleration);
    const Piece down = ramp(top, limits.start_velocity, limits.max_deceleration);
    return {up, {{random.ticks(1, 400'000)}, {std::llround(top * 0x1p64)}, {}}, down};
}

/// Removes the first ticks from the pieces and returns them.
Body take_frame(std::vector<Piece>& pieces, Ticks ticks, Random& random) {
    Body body;
    while (ticks.value > 0 && !pieces.empty() && !body.full()) {
        Piece& piece = pieces.front();
        // Cut at random as well: curves come in short pieces.
        const Ticks part{random.chance(0.5) ? random.ticks(1, 2000) : piece.ticks.value};
        const Ticks taken = std::min({part, ticks, piece.ticks});
        (void)body.push_back({taken, piece.velocity, piece.acceleration});
        ticks = ticks - taken;
        piece.velocity.raw = static_cast<std::int64_t>(piece.velocity_after(taken));
        piece.ticks = piece.ticks - taken;
        if (piece.ticks.value == 0) { pieces.erase(pieces.begin()); }
    }
    return body;
}

/// The clock estimate: a rate that changes, and jumps where an exchange has given more precise values.
class Known {
public:
    explicit Known(Random& random) : random_(random), rate_(random.real(-200e-6, 200e-6)) {}

    /// The time of the device's clock after this number of machine ticks.
    Tick goes_on(Ticks machine, bool quiet) {
        if (!quiet && random_.chance(0.3)) { rate_ = std::clamp(rate_ + random_.real(-50e-6, 50e-6), -200e-6, 200e-6); }
        if (!quiet && random_.chance(0.3)) { device_ += random_.real(-300, 300); }
        device_ += static_cast<double>(machine.value) * (1 + rate_);
        return {std::llround(device_)};
    }
    Tick then(Ticks machine) const {
        return {std::llround(device_ + static_cast<double>(machine.value) * (1 + rate_))};
    }
    double rate() const { return rate_; }

private:
    Random& random_;
    double rate_;
    double device_ = 1e6;
};

template <typename Pieces>
void make_steps(const Pieces& pieces, StepEngine& engine, std::vector<Tick>& steps) {
    for (const Piece& piece : pieces) {
        engine.begin(piece);
        engine.run(engine.now() + piece.ticks, [&](StepEdge edge) { steps.push_back(edge.tick); });
    }
}

/// Uses only the ticks of steps; allows a tick of rounding at each end, and half a tick at each end of a frame.
void expect_within_limits(const std::vector<Tick>& steps, const AxisLimits& limits) {
    constexpr double kRounding = 2;
    constexpr double kDoubles = 1 + 1e-6;
    const auto time = [&](std::size_t from, std::size_t to) {
        return static_cast<double>((steps[to] - steps[from]).value);
    };
    for (std::size_t m = 1; m < steps.size(); m *= 2) {
        const auto count = static_cast<double>(m);
        for (std::size_t n = 0; n + m < steps.size(); ++n) {
            ASSERT_LE(count / (time(n, n + m) + kRounding), limits.max_velocity * kDoubles) << "over " << m << " steps";
        }
        for (std::size_t n = m; n + m < steps.size(); ++n) {
            const double before = time(n - m, n);
            const double after = time(n, n + m);
            const double between = ((before + after + kRounding) / 2 + kRounding) * kDoubles;
            const double rise = count / (after + kRounding) - count / std::max(before - kRounding, 1e-3);
            const double fall = count / (before + kRounding) - count / std::max(after - kRounding, 1e-3);
            ASSERT_LE(rise, limits.max_acceleration * between) << "over " << m << " steps, at step " << n;
            ASSERT_LE(fall, limits.max_deceleration * between) << "over " << m << " steps, at step " << n;
        }
    }
}

class RandomMove {
public:
    explicit RandomMove(std::uint64_t seed) : random_(seed), machine_(random_machine(random_)), known_(random_) {}

    /// Runs a random move frame by frame. The tail follows a random frame.
    void run() {
        const AxisLimits planned = frame_limits_of(machine_, MotorIndex{0});
        const Ticks frame{random_.ticks(2000, 230'000)};
        FramePace pace(frame, limits());
        std::vector<Piece> pieces = random_move(random_, planned);
        const bool stops = random_.chance(0.3);
        const Tick start = known_.then({});
        pace.begin(start, known_.rate());
        StepEngine engine(start, Position::steps(0));
        while (!pieces.empty()) {
            Body body = take_frame(pieces, frame, random_);
            const Ticks lasts = total_ticks(body);
            for (const Piece& piece : body) { planned_ = planned_ + piece.covered(); }
            const Retiming when = pace.body({lasts, body.size(), known_.goes_on(lasts, false), known_.rate()});
            expect_even_pace(lasts, when);
            ASSERT_TRUE(retime(body, when));
            make_steps(body, engine, steps_);
            ASSERT_EQ(engine.position(), Position::steps(0) + planned_);
            ASSERT_EQ(engine.now(), pace.end());
            const double speed = body.back().velocity.steps_per_tick();
            if (!stops || speed < 1.5 * planned.start_velocity || random_.chance(0.7)) { continue; }
            return come_to_rest(pace, engine, pieces, planned);
        }
    }
    const std::vector<Tick>& steps() const { return steps_; }
    AxisLimits limits() const { return limits_of(machine_.axes[0], machine_.tick_ns); }
    Displacement planned() const { return planned_; }

private:
    static void expect_even_pace(Ticks lasts, const Retiming& when) {
        const auto by_device = static_cast<double>((when.end - when.start).value);
        const auto ticks = static_cast<double>(lasts.value);
        EXPECT_NEAR(by_device, ticks, ticks * FramePace::kMaxOff + 1.001);
        EXPECT_LE(std::abs(when.bend), FramePace::kMaxOff);
    }

    void come_to_rest(const FramePace& pace, StepEngine& engine, const std::vector<Piece>& left,
                      const AxisLimits& planned) {
        const double speed = left.empty() ? 0 : static_cast<double>(left.front().velocity_after({1})) * 0x1p-64;
        if (speed <= planned.start_velocity) { return; }
        Tail tail;
        (void)tail.push_back(ramp(speed, planned.start_velocity, planned.max_deceleration));
        const Ticks lasts = total_ticks(tail);
        planned_ = planned_ + tail.front().covered();
        const Retiming when = pace.tail({lasts, tail.size(), known_.then(lasts), known_.rate()});
        expect_even_pace(lasts, when);
        ASSERT_TRUE(retime(tail, when));
        make_steps(tail, engine, steps_);
        ASSERT_EQ(engine.position(), Position::steps(0) + planned_);
    }

    Random random_;
    MachineConfig machine_;
    Known known_;
    std::vector<Tick> steps_;
    Displacement planned_;
};

TEST(FramePace, EveryStepKeepsTheLimitsByTheDevicesClockDuringCorrections) {
    std::size_t steps = 0;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        RandomMove move(seed);
        move.run();
        ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed;
        expect_within_limits(move.steps(), move.limits());
        ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed;
        steps += move.steps().size();
    }
    EXPECT_GT(steps, 500'000U);
}

TEST(FramePace, AnErrorIsCorrectedWithoutOvershoot) {
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        Random random(seed);
        const MachineConfig machine = random_machine(random);
        const Ticks frame{random.ticks(2000, 230'000)};
        FramePace pace(frame, limits_of(machine.axes[0], machine.tick_ns));
        Known known(random);
        pace.begin(known.then({}) + Ticks{random.ticks(20, 400)}, known.rate());  // this much late
        std::int64_t late = 400;
        for (int i = 0; i < 20'000'000 / frame.value; ++i) {
            const Tick asked = known.goes_on(frame, true);
            (void)pace.body({frame, 1, asked, known.rate()});
            const std::int64_t now = (pace.end() - asked).value;
            ASSERT_LE(now, late + 1) << "seed " << seed << ", frame " << i;
            ASSERT_GE(now, -2) << "seed " << seed << ", frame " << i;
            late = now;
        }
        EXPECT_LE(late, 2) << "seed " << seed;
    }
}

AxisLimits some_limits() {
    return {.start_velocity = 1e-3, .max_velocity = 1e-2, .max_acceleration = 1e-6, .max_deceleration = 1e-6};
}

TEST(FramePace, ATailMakesUpForAllThatABodyMakesUpForInParts) {
    const Ticks lasts{200'000};
    FramePace pace(lasts, some_limits());
    pace.begin(Tick{1'000'000}, 0);
    const FramePace::Part late{lasts, 1, Tick{1'000'000} + lasts + Ticks{5}, 0};
    EXPECT_EQ(pace.tail(late).end, late.asked_end);
    EXPECT_LT(pace.body(late).end, late.asked_end);
}

TEST(FramePace, ANewBeginningKeepsNoPartOfATick) {
    FramePace pace(Ticks{5000}, some_limits());
    pace.begin(Tick{0}, 1e-4);
    (void)pace.body({Ticks{4900}, 1, Tick{4900}, 1e-4});  // the rate adds nearly half a tick
    pace.begin(Tick{1'000'000}, 1e-4);
    EXPECT_EQ(pace.body({Ticks{2000}, 1, Tick{1'002'000}, 1e-4}).end, Tick{1'002'000});
}

}  // namespace
}  // namespace lockstep
