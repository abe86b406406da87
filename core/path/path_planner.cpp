#include "core/path/path_planner.hpp"

#include <cmath>

namespace lockstep {

PathPlanner::PathPlanner(const PathSetup& setup)
    : setup_(setup), joiner_(setup_), window_(setup_), frames_(setup_, window_) {}

void PathPlanner::begin(std::span<const Position> at) {
    window_ = SpeedWindow(setup_);
    frames_.begin(at);
    pieces_.clear();
    at_.clear();
    for (const Position& position : at) { at_.append(position.as_steps()); }
    joiner_.begin(at_);
}

void PathPlanner::line(const PathLine& line, const MoveSettings& settings, std::int32_t number) {
    at_ = setup_.to_steps(line.to_mm);
    joiner_.add(at_, settings, number, pieces_);
    pass_on();
    if (settings.mode == PathMode::ExactStop) { rest(kLeastRest, number); }
}

std::expected<void, std::string> PathPlanner::arc(const PathArc& arc, const MoveSettings& settings,
                                                  std::int32_t number) {
    joiner_.finish(at_, pieces_);
    pass_on();
    if (auto cut = cut_arc(setup_, arc, at_, settings, number, pieces_); !cut) { return cut; }
    at_ = setup_.to_steps(arc.to_mm);
    joiner_.begin(at_);
    pass_on();
    if (settings.mode == PathMode::ExactStop) { rest(kLeastRest, number); }
    return {};
}

void PathPlanner::rest(Ticks ticks, std::int32_t number) {
    come_to_rest();
    Quadratic rest{.from = at_, .slope = zeros(at_.size()), .bend = zeros(at_.size())};
    rest.rest = std::max(ticks, kLeastRest);
    rest.line = number;
    window_.add(rest);
}

void PathPlanner::finish() {
    come_to_rest();
    window_.finish();
}

/// The last piece is moved to end on whole steps, less than half a step away.
void PathPlanner::come_to_rest() {
    AxisVector end = at_;
    for (double& steps : end) { steps = std::round(steps); }
    joiner_.finish(end, pieces_);
    at_ = end;
    if (pieces_.empty()) { return; }
    Quadratic& last = pieces_.back();
    bool moves = false;
    for (std::size_t i = 0; i < end.size(); ++i) {
        last.slope[i] = (end[i] - last.from[i]) / last.length;
        moves = moves || last.slope[i] != 0;
    }
    if (!moves) { pieces_.pop_back(); }
    for (const Quadratic& piece : pieces_) { window_.add(piece); }
    pieces_.clear();
}

void PathPlanner::pass_on() {
    if (pieces_.size() < 2) { return; }
    for (std::size_t k = 0; k + 1 < pieces_.size(); ++k) { window_.add(pieces_[k]); }
    pieces_.erase(pieces_.begin(), pieces_.end() - 1);
}

}  // namespace lockstep
