#include "tests/simulation/simtest/run/play/play_jogs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/simulation/simtest/record/motor_course.hpp"
#include "tests/simulation/simtest/run/jog_course.hpp"

namespace lockstep::simtest {
namespace {

constexpr Identity kClient = 50;

std::string reason_of(const Reply& reply) { return std::string(name_of(reply.fault)) + " " + reply.text; }

}  // namespace

void JogPlayer::play() {
    job_ = {.homing = true, .course = {}, .first_step = bench_.steps_made(), .began = bench_.vm().now()};
    if (has_course()) {
        const Counts axes = bench_.axes_at(at_);
        const Program program = program_of_jog(session_.presses.front(), bench_.machine(), bench_.kinematics(), axes);
        job_.homing = false;
        job_.course = course_of_motors(course_of(program, bench_.machine(), axes), bench_.map(), bench_.machine(), at_);
    }
    command_ = {.client = kClient, .kind = CommandKind::Jog};
    for (const JogPress& keys : session_.presses) {
        if (bench_.over() || bench_.faulted()) { break; }
        press(keys);
    }
    come_to_rest();
    record();
}

void JogPlayer::press(const JogPress& press) {
    command_.sequence = static_cast<std::uint64_t>(bench_.vm().now().value);
    command_.jogs = press.axes;
    hold_keys(press);
    if (bench_.over() || bench_.faulted()) { return; }
    check_answer(press);
    is_first_ = false;
    if (press.end != JogPress::End::Next) { release(press); }
}

/// Repeats the command, several times while it holds. A key is held at least until it is answered.
void JogPlayer::hold_keys(const JogPress& press) {
    constexpr double kRepeats = 5;
    constexpr double kAnswerSlots = 12;
    const double ticks_per_s = bench_.machine().ticks_per_second();
    const double period_s = static_cast<double>(bench_.machine().jog_hold_ticks().value) / ticks_per_s / kRepeats;
    const Tick begun = bench_.vm().now();
    const auto after = [&](double seconds) { return begun + Ticks{std::llround(seconds * ticks_per_s)}; };
    const Tick end = after(press.held_s);
    const Tick patience = after(kAnswerSlots * bench_.slot_s());
    const auto goes_on = [&] {
        const Tick now = bench_.vm().now();
        return now < end || (answer() == nullptr && now < patience);
    };
    while (goes_on() && !bench_.over() && !bench_.faulted()) {
        renewed_ = bench_.vm().now();
        bench_.vm().send(command_);
        bench_.wait(std::min(period_s, bench_.slot_s()));
    }
}

const Reply* JogPlayer::answer() const {
    for (auto reply = bench_.vm().replies().rbegin(); reply != bench_.vm().replies().rend(); ++reply) {
        if (reply->client == kClient && reply->sequence == command_.sequence) { return &*reply; }
    }
    return nullptr;
}

/// Motors of one axis with different steps may rest, after a stop on a path that began on their whole steps, where no
/// place of the axis rounds to all of them. Then the axis must be homed.
bool JogPlayer::has_astray_motors() const {
    for (const AxisIndex i : axis_indices(bench_.machine().axes.size())) {
        double least = -std::numeric_limits<double>::infinity();
        double most = std::numeric_limits<double>::infinity();
        for (std::size_t m = 0; m < bench_.map().motors(); ++m) {
            if (!bench_.map().moves_only(m, i)) { continue; }
            const double share = bench_.map().share(m, i);
            const AxisState& state = bench_.watch().motors()[m];
            const auto count = static_cast<double>(state.position.count() - state.play_steps);
            const double at = bench_.map().without_screw(m, count) / share;
            least = std::max(least, at - 0.5 / std::abs(share));
            most = std::min(most, at + 0.5 / std::abs(share));
        }
        if (least > most) { return true; }
    }
    return false;
}

/// At rest a jog is refused if one of its axes is at the end of its travel, and on a path if all are. In motion, keys
/// of axes that move only on a path are refused while others move on their own.
void JogPlayer::check_answer(const JogPress& press) {
    if (disturbed()) { return; }
    const Reply* reply = answer();
    if (reply == nullptr) { return bench_.object("jog", "no answer to a jog"); }
    if (reply->status == ReplyStatus::Accepted) { return; }
    const bool may_be_uncertain = bench_.machine().estimates_clocks() && reply->fault == FaultCode::ClockUncertain;
    const bool is_mixed = !is_first_ && reply->fault == FaultCode::BadProgram && needs_path(press);
    const auto ends = std::ranges::count_if(press.axes, [this](const JogAxis& jog) { return is_at_end(jog); });
    const std::int64_t least = needs_path(press) ? std::ssize(press.axes) : 1;
    const bool at_end = reply->fault == FaultCode::OutsideTravel && (!is_first_ || ends >= least);
    const bool is_astray = reply->fault == FaultCode::MotorsSkewed && has_astray_motors();
    if (!may_be_uncertain && !is_mixed && !at_end && !is_astray) {
        bench_.object("jog", "refused: " + reason_of(*reply));
    }
}

bool JogPlayer::needs_path(const JogPress& press) const {
    return std::ranges::any_of(press.axes, [this](const JogAxis& jog) { return !bench_.map().is_own(jog.axis); });
}

bool JogPlayer::is_at_end(const JogAxis& jog) const {
    const AxisConfig& axis = bench_.machine().axes[jog.axis];
    const double end = (jog.speed_mm_s > 0 ? axis.position_max_mm : axis.position_min_mm) * axis.steps_per_mm;
    return std::abs(static_cast<double>(bench_.axes_at(at_)[jog.axis]) - end) <= 1 + bench_.map().step_of(jog.axis);
}

/// The time from top speed to rest, on the way that takes longest.
double JogPlayer::stop_seconds() const {
    double longest = 0;
    for (const AxisConfig& axis : bench_.machine().axes) {
        longest = std::max(longest, axis.max_velocity_mm_s / axis.max_decel_mm_s2);
    }
    for (std::size_t m = 0; m < bench_.map().motors(); ++m) {
        const MotorLimits& limits = bench_.map().limits(m);
        longest = std::max(longest, limits.top / limits.decel);
    }
    return longest;
}

/// Motion by frames goes on for those that are sent ahead, which may have just begun.
double JogPlayer::reaction_seconds() const {
    const ProtocolTiming& t = bench_.machine().timing;
    constexpr double kOwnSlots = 10;  // messages from the client to the axis, with a loop at each process
    constexpr double kOwn_s = 0.02;   // the frames of an axis's own move that are in its device
    double slots = kOwnSlots;
    double seconds = kOwn_s;
    for (const JogPress& keys : session_.presses) {
        if (needs_path(keys)) { slots = kOwnSlots + 2 * t.send_ahead_slots + 3 * t.frame_slots; }
        for (const JogAxis& jog : keys.axes) {  // an axis that moves by itself stops on a whole step
            const double steps_per_s = std::abs(jog.speed_mm_s) * bench_.machine().axes[jog.axis].steps_per_mm;
            seconds = std::max(seconds, kOwn_s + 2 * bench_.map().step_of(jog.axis) / steps_per_s);
        }
    }
    // A carriage that its curve accelerates has less left to brake with.
    const double brakes = bench_.map().any_is_curved() ? 8 : 1.5;
    return slots * bench_.slot_s() + seconds + brakes * stop_seconds();
}

/// A release is repeated like any command.
void JogPlayer::release(const JogPress& press) {
    const bool by_silence = press.end == JogPress::End::Silence;
    const Tick released = by_silence ? renewed_ : bench_.vm().now();
    if (!by_silence) {
        ++command_.sequence;
        command_.jogs.clear();
        for (int n = 0; n < (bench_.lossy() ? 20 : 3); ++n) {
            bench_.vm().send(command_);
            bench_.wait(bench_.slot_s());
        }
    }
    if (&press != &session_.presses.back()) { return; }  // the next keys may move the axes on
    const Ticks within = bench_.machine().jog_hold_ticks() +
                         Ticks{std::llround(reaction_seconds() * bench_.machine().ticks_per_second())};
    bench_.recording().jogs.push_back({released, released + within, by_silence, bench_.recording().jobs.size()});
}

void JogPlayer::come_to_rest() {
    constexpr double kQuietSlots = 4;
    constexpr double kForgotten_s = 0.6;  // a client that is silent counts as gone after half a second
    const double seconds = bench_.protocol_seconds() + 2 * reaction_seconds() + kForgotten_s;
    const Ticks quiet{std::llround(kQuietSlots * static_cast<double>(bench_.machine().slot_ticks().value))};
    const auto rests = [&] {
        return bench_.watch().phase() == MachinePhase::Idle && bench_.vm().now() - bench_.watch().moved() > quiet;
    };
    if (!disturbed() && !bench_.vm().faults_pending()) { (void)bench_.await(rests, seconds, "the end of a jog"); }
    if (bench_.faulted() || disturbed() || bench_.vm().faults_pending()) { bench_.settle(seconds); }
}

void JogPlayer::record() {
    job_.end_step = bench_.steps_made();
    job_.outcome = JobOutcome::Stopped;
    for (std::size_t i = 0; i < at_.size(); ++i) {
        for (const std::int64_t way : bench_.recording().slide_ways(job_, i)) { at_[i] += way; }
    }
    // After late renewals the axes begin on whole steps of the motors beside the line.
    for (Stretch& stretch : job_.course.stretches) { stretch.within += 1; }
    job_.ended = bench_.vm().now();
    const bool is_undisturbed = !disturbed() && !bench_.faulted() && !bench_.over();
    bench_.recording().jobs.push_back(std::move(job_));
    if (is_undisturbed) { check_place(); }
}

/// The axes are within their travels, and each process reports where its motor is.
void JogPlayer::check_place() {
    const Counts axes = bench_.axes_at(at_);
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const AxisConfig& axis = bench_.machine().axes[i];
        const double step = bench_.map().step_of(i);  // 1: the axis rests on its own steps
        const double beside = bench_.map().is_own(i) && step == 1 ? 0 : step;
        const auto at = static_cast<double>(axes[i]);
        if (at < static_cast<double>(nearest_step(axis, axis.position_min_mm)) - beside ||
            at > static_cast<double>(nearest_step(axis, axis.position_max_mm)) + beside) {
            bench_.object("jog", axis.name + " has left its travel: it is at step " + std::to_string(axes[i]));
        }
    }
    for (std::size_t m = 0; m < at_.size(); ++m) {
        const AxisState& state = bench_.watch().motors()[m];
        if (state.homed && state.at_rest && state.position.count() - state.play_steps == at_[m]) { continue; }
        bench_.object("jog", bench_.kinematics().motors()[m].name + " does not report that it rests at step " +
                                 std::to_string(at_[m]));
    }
}

}  // namespace lockstep::simtest
