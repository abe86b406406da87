#include "core/path/geometry/path_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "core/path/geometry/motor_rows.hpp"
#include "core/path/geometry/travel_end.hpp"

namespace lockstep {

void PathGeometry::begin(std::span<const Position> at) {
    trail_.clear();
    ready_ = 0;
    arc_ = {};
    at_.clear();
    for (const Position& position : at) { at_.append(position.as_steps()); }
    programmed_ = at_;
    joiner_.begin(at_);
}

void PathGeometry::line(const PlaceVector& to, const MoveSettings& settings, std::uint32_t block) {
    cut_to_end();
    programmed_ = to;
    at_ = setup_.within_travel(to);
    joiner_.add(at_, settings, block, trail_);
    settings.mode == PathMode::ExactStop ? rest(kLeastRest, block) : all_but_last_are_ready();
}

void PathGeometry::begin_arc(const ArcShape& shape, const PlaceVector& to, const MoveSettings& settings,
                             std::uint32_t block) {
    cut_to_end();
    joiner_.finish(at_, trail_);
    all_but_last_are_ready();
    if (!arc_.begin(setup_, shape, {at_, programmed_, to}, settings, block)) { return line(to, settings, block); }
    programmed_ = to;
    at_ = setup_.within_travel(to);
    arc_settings_ = settings;
}

void PathGeometry::cut_on() {
    arc_.cut_on(setup_, trail_);
    arc_.is_done() ? end_arc() : all_but_last_are_ready();
}

void PathGeometry::cut_to_end() {
    while (has_more()) { cut_on(); }
}

void PathGeometry::end_arc() {
    move_end(at_);
    joiner_.begin(at_);
    arc_settings_.mode == PathMode::ExactStop ? rest(kLeastRest, arc_.block()) : all_but_last_are_ready();
}

void PathGeometry::rest(Ticks ticks, std::uint32_t block) {
    cut_to_end();
    come_to_rest();
    Quadratic rest{.from = at_, .slope = SlopeVector::zeros(at_.size()), .bend = BendVector::zeros(at_.size())};
    rest.rest = std::max(ticks, kLeastRest);
    trail_.add_rest(rest, block);
    ready_ = trail_.end();
}

void PathGeometry::finish() {
    cut_to_end();
    come_to_rest();
    ready_ = trail_.end();
}

/// Moves the end of the last piece to whole steps, by half a step at most. A piece that moves no axis then may still
/// lead the motors to their whole steps.
void PathGeometry::come_to_rest() {
    PlaceVector end = at_;
    for (double& steps : end) { steps = std::round(steps); }
    joiner_.finish(end, trail_);
    at_ = end;
    if (trail_.end() == ready_) { return; }
    const bool moves = move_end(end) || !(trail_.back().begins_at_rest || are_motors_on_steps(setup_, end));
    moves ? trail_.rest_at_end() : trail_.pop_back();
}

/// Moves the end of the last piece. Returns false if the piece begins at this place.
bool PathGeometry::move_end(const PlaceVector& end) {
    Quadratic& last = trail_.back();
    bool moves = false;
    for (std::size_t i = 0; i < end.size(); ++i) {
        last.slope[i] = (end[i] - last.from[i]) / last.length;
        moves = moves || last.slope[i] != 0;
    }
    keep_within_travel(setup_, last);
    return moves;
}

void PathGeometry::all_but_last_are_ready() {
    if (trail_.end() > ready_) { ready_ = trail_.end() - 1; }
}

/// A place of the arc that is being cut may be on a piece to come.
std::optional<PathSpot> PathGeometry::spot_of(const PathPlace& place) const {
    const bool may_be_ahead = has_more() && place.block == arc_.block();
    if (may_be_ahead && static_cast<double>(place.along.raw) * 0x1p-64 >= arc_.along()) { return std::nullopt; }
    return trail_.spot_of(place);
}

}  // namespace lockstep
