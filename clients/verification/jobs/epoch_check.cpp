#include "clients/verification/jobs/epoch_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/coordinator/epoch/touch_place.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep::verification {
namespace {

/// Returns the planned run, in machine time. `clock_error`: the tolerance of each step.
Run planned_run(const Frame& frame, MotorIndex motor, bool tail, Ticks clock_error) {
    const AxisTrack& track = frame.axes[motor];
    Run run{.epoch = frame.epoch,
            .frame = frame.number,
            .start = frame.start,
            .from = track.from,
            .pieces = {},
            .clock_error = clock_error};
    run.pieces.assign(track.body.begin(), track.body.end());
    if (!tail) { return run; }
    run.tail = true;
    run.from = run.to();
    run.start += frame.ticks;
    run.pieces.assign(track.tail.begin(), track.tail.end());
    return run;
}

}  // namespace

EpochCheck::EpochCheck(const MachineConfig& machine, EpochReplay replay, const MotorPositions& at)
    : machine_(machine), replay_(std::move(replay)) {
    for (const Position place : at) { axes_.push_back({.at = place}); }
}

std::optional<RunDifference> EpochCheck::compare(MotorIndex motor, const Run& run, bool is_behind_gap) {
    Progress& progress = axes_[motor];
    const std::string why = is_behind_gap ? "" : out_of_order(progress, run);
    if (!why.empty()) { return RunDifference{why, std::nullopt, run.start}; }
    const Frame* frame = replay_.frame(run.frame);
    if (frame == nullptr) { return RunDifference{" is not in the plan", std::nullopt, run.start}; }
    const Run planned = planned_run(*frame, motor, run.tail, run.clock_error);
    const auto joins = is_behind_gap ? std::nullopt : progress.end;
    const bool is_retimed = estimates_clock(machine_, motor) && !run.commanded_ticks.empty();
    if (auto found = is_retimed ? compare_retimed(planned, run, joins) : compare_runs(planned, run)) {
        found->text = " " + found->text;
        return found;
    }
    progress = {run.frame, run.tail, run.cut, run.cut ? Position::steps(run.stop_count) : run.to(),
                run.start + run.ticks()};
    replay_.forget_before(std::ranges::min_element(axes_, {}, &Progress::ran)->ran);
    return std::nullopt;
}

/// Returns an empty text if the run follows the axis's previous one.
std::string EpochCheck::out_of_order(const Progress& axis, const Run& run) const {
    const std::string after = fmt::format(" follows frame {}", axis.ran);
    if (axis.cut || axis.in_tail) { return after + ", with which the epoch had ended"; }
    const FrameNumber next = run.tail ? axis.ran : axis.ran + 1;
    return run.frame == next && run.frame > 0 ? "" : after;
}

std::optional<Shortfall> EpochCheck::shortfall_of(MotorIndex i) {
    const Progress& axis = axes_[i];
    const std::string frame = fmt::format("frame {}", axis.ran);
    if (ceased(i)) { return std::nullopt; }
    if (axis.cut) { return Shortfall{Shortfall::Kind::Cut, i, "was stopped early in " + frame}; }
    if (axis.ran == 0 || axis.in_tail) { return std::nullopt; }
    const Frame* last = replay_.frame(axis.ran);
    if (last == nullptr || last->last || last->axes[i].tail.empty()) { return std::nullopt; }
    return silent(i);
}

Shortfall EpochCheck::silent(MotorIndex i) const {
    const std::string after =
        axes_[i].ran == 0 ? "has no frame of its epoch in the log"
                          : fmt::format("has nothing in the log after frame {}, which is not its last", axes_[i].ran);
    return {Shortfall::Kind::Silent, i, after};
}

MotorIndex EpochCheck::least_far() const {
    const auto least = std::ranges::min_element(axes_, {}, &Progress::ran);
    return MotorIndex{static_cast<std::size_t>(least - axes_.begin())};
}

std::optional<Shortfall> EpochCheck::shortfall() {
    for (const MotorIndex m : motor_indices(axes_.size())) {
        if (auto found = shortfall_of(m)) { return found; }
    }
    const EpochEnd found = end();
    const MotorIndex least = least_far();
    switch (found.kind) {
        case EpochEnd::Kind::FramesDiffer:
            if (!axes_[least].in_tail && !axes_[least].cut) { return silent(least); }
            return Shortfall{Shortfall::Kind::Differs, found.motor, "ran other frames than the rest"};
        case EpochEnd::Kind::Misplaced:
        case EpochEnd::Kind::OffTouch:
            return Shortfall{Shortfall::Kind::Differs, found.motor, "is not where its frames end"};
        case EpochEnd::Kind::Complete:
        case EpochEnd::Kind::Interrupted: break;
    }
    return std::nullopt;
}

Position EpochCheck::rests_at(MotorIndex motor, const Frame& frame) const {
    const Run body = planned_run(frame, motor, false, {});
    return frame.last ? body.to() : planned_run(frame, motor, true, {}).to();
}

bool EpochCheck::assume_complete(MotorIndex motor) {
    const FrameNumber most = ran();
    const Frame* last = most > 0 ? replay_.frame(most) : nullptr;
    if (last == nullptr) { return false; }
    axes_[motor] = {most, !last->last, false, rests_at(motor, *last), std::nullopt};
    return true;
}

EpochEnd EpochCheck::end() const {
    std::vector<AxisEnd> ends;
    for (const MotorIndex m : motor_indices(axes_.size())) { ends.push_back({axes_[m].ran, axes_[m].at, ceased(m)}); }
    return replay_.evaluate(ends);
}

bool EpochCheck::ceased(MotorIndex motor) const { return axes_[motor].cut && replay_.touch().ceasing(motor); }

std::optional<std::string> EpochCheck::rests_off_touch(Tick touched) const {
    MotorPositions rests;
    for (const Progress& axis : axes_) { rests.append(axis.at); }
    const RunFrames frames{replay_.begin(), [&](Tick tick) { return replay_.positions_at(tick, ran()); }};
    const auto off = off_touch(machine_, replay_.touch(), touched, frames, rests);
    if (!off) { return std::nullopt; }
    return fmt::format("motor {} rests at step {}; its pulses had to cease at step {}",
                       motor_name(machine_, off->motor), off->rests, off->due);
}

FrameNumber EpochCheck::ran() const { return std::ranges::max_element(axes_, {}, &Progress::ran)->ran; }

std::vector<Course> EpochCheck::courses_of(MotorIndex motor, EpochReplay& ahead) const {
    const Progress& progress = axes_[motor];
    std::vector<Course> courses;
    if (progress.cut || progress.in_tail) { return courses; }
    Course frames;
    const auto unrecorded = static_cast<FrameNumber>(frames_ahead(machine_.timing)) + 1;
    for (FrameNumber number = progress.ran; number <= progress.ran + unrecorded; ++number) {
        const Frame* frame = number > 0 ? ahead.frame(number) : nullptr;
        if (number > progress.ran && frame == nullptr) { break; }
        if (number > progress.ran) { frames.push_back(planned_run(*frame, motor, false, known_within())); }
        Course course = frames;
        if (frame != nullptr) { course.push_back(planned_run(*frame, motor, true, known_within())); }
        if (!course.empty()) { courses.push_back(std::move(course)); }
    }
    return courses;
}

}  // namespace lockstep::verification
