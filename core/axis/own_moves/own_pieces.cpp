#include "core/axis/own_moves/own_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/kinematics/motors.hpp"
#include "core/motion/interpolate.hpp"
#include "core/number_text.hpp"
#include "core/program.hpp"

namespace lockstep {
namespace {

std::string text_in_time(const Infeasible& lack, const MotorConfig& motor, std::int64_t tick_ns,
                         const OwnMoveRequest& move) {
    const double tick_s = static_cast<double>(tick_ns) * 1e-9;
    const std::string time = short_number(static_cast<double>(move.ticks->value) * tick_s) + " s";
    return short_number(to_mm(motor, static_cast<double>(move.steps))) + " mm in " + time +
           " would exceed the limits of axis " + motor.name + ": the move takes at least " +
           short_number(static_cast<double>(lack.least_ticks.value) * tick_s) + " s, and the distance in " + time +
           " is at most " + short_number(std::max(0.0, to_mm(motor, lack.longest.as_steps()))) + " mm";
}

/// A plan in the time that was asked for.
std::expected<Profile, OwnMoveError> profile_in_time(const MotorConfig& motor, std::int64_t tick_ns,
                                                     const OwnMoveRequest& move, const PathLimits& limits) {
    const double most_s = std::min(kLongestMotion_s, to_mm(motor, static_cast<double>(move.steps)) / kLeastSpeed_mm_s);
    if (static_cast<double>(move.ticks->value) * static_cast<double>(tick_ns) * 1e-9 > most_s) {
        return std::unexpected(BelowLeastSpeed{most_s});
    }
    auto profile = plan_in_time(Displacement::steps(move.steps), *move.ticks, limits);
    if (!profile) { return std::unexpected(profile.error()); }
    return *profile;
}

}  // namespace

std::string text_of(const OwnMoveError& error, const MotorConfig& motor, std::int64_t tick_ns,
                    const OwnMoveRequest& move) {
    if (const auto* other = std::get_if<NotInTime>(&error)) {
        return "axis " + motor.name + " cannot move in a given time by method " + std::string(name_of(other->method)) +
               "; omit the time, or configure method RANADE";
    }
    if (const auto* slow = std::get_if<BelowLeastSpeed>(&error)) {
        return "axis " + motor.name + " would be slower than " + short_number(kLeastSpeed_mm_s) +
               " mm/s: " + short_number(to_mm(motor, static_cast<double>(move.steps))) + " mm may take at most " +
               short_number(slow->most_s) + " s";
    }
    if (const auto* lack = std::get_if<Infeasible>(&error)) { return text_in_time(*lack, motor, tick_ns, move); }
    return "axis " + motor.name + ": " + text_of(std::get<StepError>(error));
}

StepMove step_move_of(const MotorConfig& motor, const OwnMoveRequest& move) {
    const double per_mm = motor.steps_per_mm;
    const double max = move.speed_mm_s * per_mm;
    return {move.steps, std::min(motor.start_velocity_mm_s * per_mm, max), max, motor.max_accel_mm_s2 * per_mm,
            motor.max_decel_mm_s2 * per_mm};
}

std::expected<OwnPieces, OwnMoveError> OwnPieces::plan(const MotorConfig& motor, std::int64_t tick_ns,
                                                       StepMethod method, const OwnMoveRequest& move,
                                                       BeginSteps begin_steps) {
    if (method == StepMethod::Ranade) { return planned(motor, tick_ns, move); }
    if (!move.ticks) { return stepped(motor, tick_ns, method, move, begin_steps); }
    return std::unexpected(NotInTime{method});
}

std::expected<OwnPieces, OwnMoveError> OwnPieces::planned(const MotorConfig& motor, std::int64_t tick_ns,
                                                          const OwnMoveRequest& move) {
    const AxisLimits of_axis = limits_of(motor, tick_ns);
    const double speed =
        std::min(move.speed_mm_s * motor.steps_per_mm * static_cast<double>(tick_ns) * 1e-9, kMaxPlannedStepsPerTick);
    const PathLimits limits{std::min(of_axis.start_velocity, speed), speed, of_axis.max_acceleration,
                            of_axis.max_deceleration};
    const Displacement way = Displacement::steps(move.steps);
    Profile profile;
    if (!move.ticks) {
        profile = plan_fastest({{}, way, limits.start_velocity, limits.start_velocity, limits});
    } else if (auto in_time = profile_in_time(motor, tick_ns, move, limits)) {
        profile = *in_time;
    } else {
        return std::unexpected(in_time.error());
    }
    return OwnPieces(Planned{pieces_of(profile, Position{}, +1)});
}

std::expected<OwnPieces, OwnMoveError> OwnPieces::stepped(const MotorConfig& motor, std::int64_t tick_ns,
                                                          StepMethod method, const OwnMoveRequest& move,
                                                          BeginSteps begin_steps) {
    const double ticks_per_s = 1e9 / static_cast<double>(tick_ns);
    const double start = motor.start_velocity_mm_s * motor.steps_per_mm;
    const StepMove asked = step_move_of(motor, move);
    auto source = begin_steps(method, asked);
    if (!source) { return std::unexpected(source.error()); }
    const LimitWatch watch({start, asked.acceleration, asked.deceleration});
    return OwnPieces(Stepped{std::move(*source), watch, ticks_per_s, move.steps});
}

/// A cut changes no step, also between two of them: the rest begins at the velocity that the register has there.
std::optional<Piece> OwnPieces::next(Ticks most) {
    auto piece = rest_ ? std::exchange(rest_, std::nullopt)
                       : std::visit([most](auto& maker) { return maker.next(most); }, maker_);
    if (!piece || piece->ticks <= most + most) { return piece; }
    const auto velocity = static_cast<std::int64_t>(piece->velocity_after(most));
    rest_ = Piece{piece->ticks - most, {velocity}, piece->acceleration};
    piece->ticks = most;
    return piece;
}

bool OwnPieces::is_made() const {
    return std::visit([](const auto& maker) { return maker.done(); }, maker_);
}

bool OwnPieces::is_breached() const {
    return std::visit([](const auto& maker) { return maker.broken(); }, maker_);
}

std::optional<Piece> OwnPieces::Stepped::next(Ticks most) {
    while (left > 0 && !breach) {
        const std::optional<double> step_s = next_step_s();
        if (!step_s) { break; }
        if (auto before = pieces.add(*step_s * ticks_per_s)) { return before; }
        if (pieces.last_step() - pieces.begin() >= most) { return pieces.cut(); }
    }
    if (auto rest = pieces.cut()) { return rest; }
    if (at_rest || breach) { return std::nullopt; }
    at_rest = true;
    return pieces.last_half();
}

/// Returns nullopt if the step would break the limits.
std::optional<double> OwnPieces::Stepped::next_step_s() {
    const double at_s = source->next_s();
    breach = watch.step(at_s - before_s).has_value();
    before_s = at_s;
    if (breach) { return std::nullopt; }
    --left;
    return at_s;
}

}  // namespace lockstep
