#include "core/coordinator/path/lai_frames.hpp"

#include <algorithm>

#include "core/motion/frame_limits.hpp"
#include "core/motion/interpolate.hpp"

namespace lockstep {

LaiFrames::LaiFrames(const MachineConfig& machine, std::shared_ptr<const ProgramBlocks> program,
                     std::vector<PathMove> moves, EventQueue events, const LegEnd& end)
    : machine_(machine),
      program_(std::move(program)),
      events_(std::move(events)),
      end_(end),
      limits_(frame_limits_of(machine)) {
    for (const AxisConfig& axis : machine.axes) { steps_per_mm_.push_back(axis.steps_per_mm); }
    path_.moves = std::move(moves);
}

void LaiFrames::resume(const PathPlace& place, std::span<const Position> at, const Overrides&) {
    const Spot spot = spot_of(place);
    passed_ = {place.block, place.along - spot.along};
    const std::vector<PathMove> left(path_.moves.begin() + static_cast<std::ptrdiff_t>(spot.move), path_.moves.end());
    path_ = left.empty()
                ? Path{}
                : plan_lai_path(left, spot.along, limits_, steps_per_mm_, machine_.tick_ns, least_move(machine_));
    made_ = {};
    at_.clear();
    for (const Position& position : at) { at_.append(position); }
    events_.resume(place.block);
}

/// The end of a part counts as the beginning of the next one.
LaiFrames::Spot LaiFrames::spot_of(const PathPlace& place) const {
    Displacement left = place.along - before(place.block);
    for (std::size_t k = 0; k < path_.moves.size(); ++k) {
        const PathMove& move = path_.moves[k];
        if (move.block < place.block) { continue; }
        const Displacement whole = Displacement::steps(move.lead);
        if (move.block > place.block) { return {k, {}}; }
        if (move.lead == 0 || left < whole) { return {k, left}; }
        left = left - whole;
    }
    return {path_.moves.size(), {}};
}

PathPlace LaiFrames::place_of(const PathMove& move, Displacement along) const {
    PathPlace place{move.block, before(move.block) + along};
    for (const PathMove* before = &move; before != path_.moves.data() && (before - 1)->block == move.block;) {
        --before;
        place.along = place.along + Displacement::steps(before->lead);
    }
    return place;
}

PathPlace LaiFrames::place_at(Ticks t) const {
    const PathMove& move = path_.moves[path_.move_at(subticks(t))];
    return place_of(move, move.along_at(subticks(t)));
}

std::expected<const PathFrame*, PathStuck> LaiFrames::next() {
    const Ticks whole = path_.duration().ceil();
    PathFrame& frame = frame_;
    frame.ticks = std::min(machine_.frame_ticks(), whole - made_);
    const auto parts = static_cast<std::int64_t>(frame.places.size());
    for (std::int64_t k = 0; k < parts; ++k) {
        frame.places[static_cast<std::size_t>(k)] = place_at(made_ + Ticks{frame.ticks.value * k / parts});
    }
    frame.begin = frame.places[0];
    frame.axes.resize(at_.size());
    for (std::size_t i = 0; i < at_.size(); ++i) {
        frame.axes[i].from = at_[i];
        frame.axes[i].body.clear();
        frame.axes[i].tail.clear();
    }
    pieces_.resize(at_.size());
    PieceSource source(path_, made_, made_ + frame.ticks, {at_.begin(), at_.size()});
    while (source.next(pieces_)) {
        for (std::size_t i = 0; i < pieces_.size(); ++i) { frame.axes[i].body.append(pieces_[i]); }
    }
    made_ += frame.ticks;
    last_ = frame.ticks;
    frame.last = is_done();
    frame.rest = frame.last ? place_at(whole) : fill_tail(frame, at_);
    note_begins();
    events_.take_due(frame, begins_, due_);
    return &frame_;
}

void LaiFrames::note_begins() {
    begins_.clear();
    const Ticks begin = made_ - last_;
    for (std::size_t k = path_.move_at(subticks(begin)); k < path_.moves.size(); ++k) {
        const PathMove& move = path_.moves[k];
        if (move.start > subticks(made_)) { break; }
        const bool is_first = k == 0 || path_.moves[k - 1].block != move.block;
        const double at = static_cast<double>((move.start - subticks(begin)).value) / kSubticksPerTick;
        if (is_first && at >= 0) { begins_.push_back({move.block, at}); }
    }
}

PathPlace LaiFrames::fill_tail(PathFrame& frame, MotorPositions at) {
    brake_from(path_, subticks(made_), limits_, tail_);
    if (tail_.empty()) { return place_at(made_); }
    PieceSource source(tail_, Ticks{0}, tail_.duration().ceil(), {at.begin(), at.size()});
    while (source.next(pieces_)) {
        for (std::size_t i = 0; i < pieces_.size(); ++i) { frame.axes[i].tail.append(pieces_[i]); }
    }
    const PathMove& rests_in = tail_.moves.back();
    const auto is_it = [&](const PathMove& m) { return m.block == rests_in.block && m.part == rests_in.part; };
    const auto from = path_.moves.begin() + static_cast<std::ptrdiff_t>(path_.move_at(subticks(made_)));
    return place_of(*std::find_if(from, path_.moves.end(), is_it), rests_in.profile.phases.back().to);
}

double LaiFrames::seconds_from(const PathPlace& place) const {
    const double behind_s = program_->seconds_from({end_.block, {}});
    const Spot spot = spot_of(place);
    if (spot.move == path_.moves.size()) { return behind_s; }
    const Subticks left = path_.duration() - path_.moves[spot.move].start;
    return behind_s + static_cast<double>(left.value) / kSubticksPerTick / machine_.ticks_per_second();
}

}  // namespace lockstep
