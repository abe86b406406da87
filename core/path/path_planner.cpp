#include "core/path/path_planner.hpp"

#include <cmath>

#include "core/path/travel_end.hpp"

namespace lockstep {

PathPlanner::PathPlanner(const PathSetup& setup)
    : setup_(setup), joiner_(setup_), window_(setup_), frames_(setup_, window_, trail_) {}

PathPlanner::PathPlanner(const PathPlanner& other)
    : setup_(other.setup_),
      overrides_(other.overrides_),
      joiner_(other.joiner_),
      trail_(other.trail_),
      window_(other.window_),
      frames_(other.frames_, setup_, window_, trail_),
      at_(other.at_),
      programmed_(other.programmed_),
      start_(other.start_),
      is_sought_(other.is_sought_),
      ready_(other.ready_),
      passed_(other.passed_),
      is_finished_(other.is_finished_),
      begins_(other.begins_) {}

void PathPlanner::begin(std::span<const Position> at) {
    trail_.clear();
    ready_ = passed_ = 0;
    is_finished_ = false;
    at_.clear();
    for (const Position& position : at) { at_.append(position.as_steps()); }
    programmed_ = at_;
    joiner_.begin(at_);
    resume({}, at);
}

void PathPlanner::resume(const PathPlace& place, std::span<const Position> at) {
    begins_.clear();
    frames_.begin(at);
    seek(place);
}

/// Refills the window from a place on.
void PathPlanner::seek(const PathPlace& place) {
    start_ = place;
    is_sought_ = true;
    window_.restart(overrides_, {});
    pass_on(ready_);
    if (is_finished_) { window_.finish(); }
}

void PathPlanner::line_to_steps(const AxisVector& to, const MoveSettings& settings, std::uint32_t block) {
    programmed_ = to;
    at_ = setup_.within_travel(to);
    joiner_.add(at_, settings, block, trail_);
    settings.mode == PathMode::ExactStop ? rest(kLeastRest, block) : pass_on_but_last();
}

void PathPlanner::arc_to_steps(const ArcShape& shape, const AxisVector& to, const MoveSettings& settings,
                               std::uint32_t block) {
    joiner_.finish(at_, trail_);
    pass_on_but_last();
    if (!cut_arc(setup_, shape, {at_, programmed_, to}, settings, block, trail_)) {
        return line_to_steps(to, settings, block);
    }
    programmed_ = to;
    at_ = setup_.within_travel(to);
    move_end(at_);
    joiner_.begin(at_);
    settings.mode == PathMode::ExactStop ? rest(kLeastRest, block) : pass_on_but_last();
}

void PathPlanner::rest(Ticks ticks, std::uint32_t block) {
    come_to_rest();
    Quadratic rest{.from = at_, .slope = zeros(at_.size()), .bend = zeros(at_.size())};
    rest.rest = std::max(ticks, kLeastRest);
    trail_.add_rest(rest, block);
    pass_on(trail_.end());
}

void PathPlanner::finish() {
    come_to_rest();
    pass_on(trail_.end());
    is_finished_ = true;
    window_.finish();
}

/// Moves the end of the last piece to whole steps, by half a step at most.
void PathPlanner::come_to_rest() {
    AxisVector end = at_;
    for (double& steps : end) { steps = std::round(steps); }
    joiner_.finish(end, trail_);
    at_ = end;
    if (trail_.end() == ready_) { return; }
    if (!move_end(end)) { trail_.pop_back(); }
}

/// Moves the end of the last piece. Returns false if the piece begins at this place.
bool PathPlanner::move_end(const AxisVector& end) {
    Quadratic& last = trail_.back();
    bool moves = false;
    for (std::size_t i = 0; i < end.size(); ++i) {
        last.slope[i] = (end[i] - last.from[i]) / last.length;
        moves = moves || last.slope[i] != 0;
    }
    keep_within_travel(setup_, last);
    return moves;
}

void PathPlanner::pass_on_but_last() {
    if (trail_.end() > ready_) { pass_on(trail_.end() - 1); }
}

/// Passes final pieces to the window. Pieces before the place where the path continues are dropped.
void PathPlanner::pass_on(std::size_t ready) {
    ready_ = ready;
    if (is_sought_) {
        const auto spot = trail_.spot_of(start_);
        passed_ = spot ? spot->piece : ready;
        if (!spot) { return trail_.drop_before(ready); }
        window_.restart(overrides_, *spot);
        is_sought_ = false;
    }
    for (; passed_ < ready; ++passed_) { window_.add(trail_.piece(passed_)); }
}

TurnResult PathPlanner::turn(const Overrides& overrides) {
    if (frames_.has_made()) {
        const TurnResult result = frames_.turn(overrides);
        if (result == TurnResult::Taken) { overrides_ = overrides; }
        return result;
    }
    overrides_ = overrides;
    frames_.restart();
    seek(start_);
    return TurnResult::Taken;
}

std::expected<const PathFrame*, PathStuck> PathPlanner::next() {
    const auto frame = frames_.next();
    if (frame && *frame) { remember(**frame); }
    return frame;
}

void PathPlanner::remember(const PathFrame& frame) {
    begins_.push_back(trail_.spot_of(frame.begin)->piece);
    if (begins_.size() <= kFramesKept) { return; }
    begins_.pop_front();
    trail_.drop_before(begins_.front());
}

}  // namespace lockstep
