#include "core/path/path_planner.hpp"

#include "core/path/geometry/motor_rows.hpp"

namespace lockstep {

PathPlanner::PathPlanner(const PathSetup& setup)
    : PathInput(setup), setup_(setup), window_(setup_), frames_(setup_, window_, geometry_.trail()) {}

PathPlanner::PathPlanner(const PathPlanner& other)
    : PathInput(other),
      setup_(other.setup_),
      overrides_(other.overrides_),
      window_(other.window_),
      frames_(other.frames_, setup_, window_, geometry_.trail()),
      start_(other.start_),
      at_(other.at_),
      is_sought_(other.is_sought_),
      passed_(other.passed_),
      is_finished_(other.is_finished_),
      begins_(other.begins_) {}

void PathPlanner::begin(std::span<const Position> at) {
    passed_ = 0;
    is_finished_ = false;
    geometry_.begin(at);
    const MotorPositions motors = motors_at_rest(setup_, at);
    resume({}, {motors.begin(), motors.size()});
}

void PathPlanner::resume(const PathPlace& place, std::span<const Position> at) {
    begins_.clear();
    at_.clear();
    for (const Position& position : at) { at_.append(position); }
    frames_.begin(at);
    seek(place);
}

/// Refills the window from a place on.
void PathPlanner::seek(const PathPlace& place) {
    start_ = place;
    is_sought_ = true;
    window_.restart(overrides_, {}, {at_.begin(), at_.size()});
    pass_on();
    if (is_finished_) { window_.finish(); }
}

void PathPlanner::cut_on() {
    geometry_.cut_on();
    pass_on();
}

void PathPlanner::arc_to_steps(const ArcShape& shape, const PlaceVector& to, const MoveSettings& settings,
                               std::uint32_t block) {
    begin_arc_to_steps(shape, to, settings, block);
    while (has_more()) { cut_on(); }
}

void PathPlanner::end() {
    is_finished_ = true;
    window_.finish();
}

/// Passes final pieces to the window. Pieces before the place where the path continues are dropped.
void PathPlanner::pass_on() {
    const std::size_t ready = geometry_.ready();
    if (is_sought_) {
        const auto spot = geometry_.spot_of(start_);
        passed_ = spot ? spot->piece : ready;
        if (!spot) { return geometry_.drop_before(ready); }
        window_.restart(overrides_, *spot, {at_.begin(), at_.size()});
        is_sought_ = false;
    }
    for (; passed_ < ready; ++passed_) { window_.add(geometry_.trail().piece(passed_)); }
}

OverrideResult PathPlanner::set_overrides(const Overrides& overrides) {
    if (frames_.has_made()) {
        const OverrideResult result = frames_.set_overrides(overrides);
        if (result == OverrideResult::Taken) { overrides_ = overrides; }
        return result;
    }
    overrides_ = overrides;
    frames_.restart();
    seek(start_);
    return OverrideResult::Taken;
}

std::expected<const PathFrame*, PathStuck> PathPlanner::next(FrameRoom* room) {
    const auto frame = frames_.next(room);
    if (frame && *frame) { remember(**frame); }
    return frame;
}

void PathPlanner::remember(const PathFrame& frame) {
    begins_.push_back(geometry_.trail().spot_of(frame.begin)->piece);
    if (begins_.size() <= kFramesKept) { return; }
    begins_.pop_front();
    geometry_.drop_before(begins_.front());
}

}  // namespace lockstep
