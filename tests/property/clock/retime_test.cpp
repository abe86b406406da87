// Random motion for a device with a different clock: every end is exact in every bit, and each step is within two
// ticks.
#include "core/axis/device/retime.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "core/step/engine.hpp"

namespace lockstep {
namespace {

using Body = StaticVector<Piece, kMaxBodyPieces + 1>;

/// The content of a frame: phases of constant acceleration, some of a single tick.
Body random_body(std::mt19937_64& random) {
    const auto real = [&](double least, double most) { return std::uniform_real_distribution(least, most)(random); };
    Body body;
    const double direction = random() % 2 == 0 ? 1 : -1;
    double speed = direction * real(0.01, 0.2);
    for (std::size_t n = 1 + random() % kMaxBodyPieces; n > 0; --n) {
        const Ticks ticks{random() % 10 == 0 ? 1 : static_cast<std::int64_t>(real(1, 20'000))};
        const double to = direction * real(0.01, 0.2);
        const double acceleration = (to - speed) / static_cast<double>(ticks.value);
        (void)body.push_back(
            {ticks, {std::llround((speed - acceleration / 2) * 0x1p64)}, {std::llround(acceleration * 0x1p64)}});
        speed = to;
    }
    return body;
}

struct Made {
    std::vector<Tick> steps;
    Position end;
};

Made run(const Body& body, Tick start) {
    StepEngine engine(start, Position::steps(3));
    Made made;
    for (const Piece& piece : body) {
        engine.begin(piece);
        engine.run(engine.now() + piece.ticks, [&](StepEdge edge) { made.steps.push_back(edge.tick); });
    }
    made.end = engine.position();
    return made;
}

class RetimedBodies : public testing::TestWithParam<std::uint64_t> {};

TEST_P(RetimedBodies, MeetTheirEndsBitForBitAndEveryStepWithinTwoTicks) {
    std::mt19937_64 random(GetParam());
    for (int run_number = 0; run_number < 75; ++run_number) {
        const Body body = random_body(random);
        const double rate = 1 + std::uniform_real_distribution(-300e-6, 300e-6)(random);
        const Tick start{1'000'000};
        const auto to_device = [&](Tick machine) {
            return Tick{std::llround(static_cast<double>((machine - start).value) * rate) + 7'000'000};
        };
        const Tick device_end = std::max(to_device(start + total_ticks(body)), to_device(start) + Ticks{300});
        Body device = body;
        const double bend = std::uniform_real_distribution(-500e-6, 500e-6)(random);
        const Retiming when{to_device(start), device_end, run_number % 2 == 0 ? 0 : bend};
        ASSERT_TRUE(retime(device, when));
        EXPECT_LE(device.size(), body.size() + 1);
        EXPECT_EQ(to_device(start) + total_ticks(device), device_end);
        const Made planned = run(body, start);
        const Made made = run(device, to_device(start));
        ASSERT_EQ(made.end, planned.end) << "run " << run_number;
        ASSERT_EQ(made.steps.size(), planned.steps.size());
        for (std::size_t i = 0; i < made.steps.size(); ++i) {
            ASSERT_LE(std::abs((made.steps[i] - to_device(planned.steps[i])).value), 2 + when.bow().value)
                << "step " << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RetimedBodies, testing::Range<std::uint64_t>(5, 9));

TEST(Retime, AClockOfTheSameRateChangesNothing) {
    std::mt19937_64 random(6);
    for (int i = 0; i < 100; ++i) {
        const Body body = random_body(random);
        Body device = body;
        const Ticks ahead{123};
        const Tick start{50};
        ASSERT_TRUE(retime(device, {start + ahead, start + ahead + total_ticks(body)}));
        EXPECT_EQ(device, body);
    }
}

/// An estimate has improved by a hundredth of the frame, and the first piece is shorter than that.
TEST(Retime, ACorrectionIsSpreadOverTheWholeFrame) {
    Body body;
    for (const std::int64_t ticks : {50, 5000, 50, 4900}) {
        (void)body.push_back({{ticks}, {std::int64_t{1} << 58}, {}});
    }
    Body device = body;
    ASSERT_TRUE(retime(device, {{0}, {10'100}}));
    for (const Piece& piece : device) {
        const double faster = static_cast<double>(piece.velocity.raw) / static_cast<double>(std::int64_t{1} << 58);
        EXPECT_NEAR(faster, 10'000.0 / 10'100, 1e-9) << "however short the piece";
    }
    EXPECT_EQ(run(device, {0}).end, run(body, {0}).end);
}

TEST(Retime, PiecesOfASingleTickKeepATickEach) {
    Body body;
    for (int i = 0; i < 100; ++i) { (void)body.push_back({{1}, {std::int64_t{1} << 60}, {}}); }
    Body device = body;
    ASSERT_TRUE(retime(device, {{0}, {100}}));
    EXPECT_EQ(device.size(), 100u);
    EXPECT_EQ(run(device, {0}).end, run(body, {0}).end);
}

}  // namespace
}  // namespace lockstep
