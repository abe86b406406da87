// The moves that an axis makes by itself stay as recorded: their pieces, frames and tails, their refusals, and the
// steps of homing. To write the files: LOCKSTEP_WRITE_HASHES=1 build/bin/property_axis --gtest_filter='*StayAsRecorded'
#include <cmath>
#include <random>

#include "core/axis/own_moves/homing.hpp"
#include "core/axis/own_moves/own_move.hpp"
#include "core/methods/paper_steps.hpp"
#include "core/program.hpp"
#include "tests/property/recorded_hashes.hpp"
#include "tests/property/recorded_text.hpp"

namespace lockstep {
namespace {

constexpr std::uint32_t kMoves = 1'500;
constexpr std::uint32_t kHomings = 1'000;
constexpr std::int64_t kMostFrames = 60;

class Drawn {
public:
    explicit Drawn(std::uint32_t seed) : random_(seed) {}
    bool one_of(std::uint64_t n) { return random_() % n == 0; }
    std::int64_t below(std::int64_t n) { return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(n)); }
    /// A power of ten, times 1 to 9.
    double of_any_size(int least_power, int powers) {
        const double power = std::pow(10, static_cast<double>(least_power + below(powers)));
        return static_cast<double>(1 + below(9)) * power;
    }

private:
    std::mt19937_64 random_;
};

MotorConfig draw_motor(Drawn& drawn) {
    MotorConfig motor{.name = "X"};
    motor.moves_one_axis = !drawn.one_of(3);
    motor.steps_per_mm = static_cast<double>(10 + 10 * drawn.below(40));
    motor.max_velocity_mm_s = static_cast<double>(5 + drawn.below(200));
    motor.start_velocity_mm_s = motor.max_velocity_mm_s / static_cast<double>(1 + drawn.below(20));
    motor.max_accel_mm_s2 = static_cast<double>(100 + 100 * drawn.below(40));
    motor.max_decel_mm_s2 = drawn.one_of(2) ? motor.max_accel_mm_s2 : static_cast<double>(100 + 100 * drawn.below(40));
    motor.position_min_mm = -static_cast<double>(drawn.below(100));
    motor.position_max_mm = static_cast<double>(1 + drawn.below(300));
    motor.method = static_cast<StepMethod>(drawn.below(5));
    return motor;
}

void record_frames(RecordedText& text, OwnMove frames) {
    for (std::int64_t k = 0; k < kMostFrames && !frames.all_made(); ++k) {
        const HeldFrame frame = frames.next();
        text.line(frame.number, frame.start, frame.ticks, frame.last, frame.track, frames.none_made(), frames.broken());
    }
    text.line(frames.all_made(), frames.end());
}

/// Most moves are possible. The others have too little time, or too little speed.
std::string move_of(std::uint32_t number) {
    Drawn drawn(number);
    const MotorConfig motor = draw_motor(drawn);
    const std::int64_t tick_ns = drawn.one_of(3) ? 250 : 1000;
    OwnMoveRequest request{1 + drawn.below(drawn.one_of(2) ? 20 : 20'000), motor.max_velocity_mm_s};
    if (drawn.one_of(2)) { request.speed_mm_s = std::min(request.speed_mm_s, drawn.of_any_size(-5, 8)); }
    if (drawn.one_of(3)) { request.ticks = Ticks{static_cast<std::int64_t>(drawn.of_any_size(2, 7))}; }
    const StepMethod method = request.ticks && !drawn.one_of(4) ? StepMethod::Ranade : motor.method;
    const StepMove move = step_move_of(motor, request);
    RecordedText text;
    text.line(move.steps, move.start, move.max, move.acceleration, move.deceleration);
    auto pieces = OwnPieces::plan(motor, tick_ns, method, request, methods::begin_steps);
    if (!pieces) { return text.line(text_of(pieces.error(), motor, tick_ns, request)).text(); }
    const bool backward = drawn.one_of(2);
    const Ticks span{500 + drawn.below(20'000)};
    const std::int64_t from = drawn.below(1000) - 500;
    const Ticks to_whole_step{drawn.below(3) * span.value / 2};
    const OwnMove::Place place{rest_position(from, backward), backward, request.steps, Tick{drawn.below(1'000'000)}};
    record_frames(text, OwnMove(std::move(*pieces), place, limits_of(motor, tick_ns), {span, to_whole_step}));
    return text.text();
}

void draw_homing(Drawn& drawn, HomingConfig& homing) {
    homing.way = drawn.one_of(12) ? HomingWay::InPlace : HomingWay::BySwitch;
    homing.toward_min = drawn.one_of(2);
    homing.search_velocity_mm_s = static_cast<double>(1 + drawn.below(10));
    homing.latch_velocity_mm_s = static_cast<double>(1 + drawn.below(3)) / 2;
    homing.pulloff_mm = static_cast<double>(1 + drawn.below(5)) / 2;
    homing.touch_tolerance_mm = static_cast<double>(drawn.below(4)) / 50;
    homing.switch_position_mm = static_cast<double>(drawn.below(40) - 20);
    homing.park_mm = static_cast<double>(drawn.below(100) - 20);
}

/// Touches are near each other, exactly as far apart as they may be, or farther.
LocalEnd draw_end(Drawn& drawn, std::int64_t tolerance) {
    const auto about = [&] {
        const std::int64_t apart = tolerance * drawn.below(2);
        return apart + drawn.below(3) - 1;
    };
    const std::int64_t count = about();
    const bool fails = drawn.one_of(10);
    return {.by_trigger = !fails,
            .by_limit = fails && drawn.one_of(2),
            .home_closed = drawn.one_of(6),
            .count = count + drawn.below(3),
            .trigger_count = count,
            .encoder_ahead = drawn.one_of(3) ? about() : 0};
}

void record(RecordedText& text, const HomingStep& step, HomingStage stage) {
    text.line(stage, step.zeroed, step.zero_count, step.done, step.fault, step.move.has_value());
    if (!step.move) { return; }
    text.line(step.move->steps, step.move->speed_mm_s, step.move->trigger, step.move->ticks);
}

std::string homing_of(std::uint32_t number) {
    constexpr int kMostSteps = 50;
    Drawn drawn(number);
    MotorConfig motor = draw_motor(drawn);
    motor.plant.travel_margin_mm = static_cast<double>(1 + drawn.below(100));
    draw_homing(drawn, motor.homing);
    const std::int64_t tolerance =
        std::max<std::int64_t>(1, std::llround(motor.homing.touch_tolerance_mm * motor.steps_per_mm));
    RecordedText text;
    Homing homing(motor);
    const bool closed = drawn.one_of(3);
    const auto begun = drawn.one_of(4) ? homing.approach(closed) : homing.begin(closed, drawn.below(1000) - 500);
    record(text, begun, homing.stage());
    for (int k = 0; k < kMostSteps && homing.stage() != HomingStage::Idle; ++k) {
        const HomingStep step = homing.next(draw_end(drawn, tolerance));
        record(text, step, homing.stage());
    }
    return text.text();
}

TEST(OwnMovesOfAnAxis, StayAsRecorded) { expect_recorded("tests/property/axis/own_moves.txt", kMoves, move_of); }
TEST(StepsOfHoming, StayAsRecorded) { expect_recorded("tests/property/axis/homing.txt", kHomings, homing_of); }

}  // namespace
}  // namespace lockstep
