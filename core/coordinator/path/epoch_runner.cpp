#include "core/coordinator/path/epoch_runner.hpp"

#include <algorithm>

#include "core/motion/frame_limits.hpp"
#include "core/motion/interpolate.hpp"

namespace lockstep {

EpochRunner::EpochRunner(const MachineConfig& machine)
    : machine_(machine), limits_(frame_limits_of(machine)), slot_(machine.slot_ticks()) {}

void EpochRunner::begin(Epoch epoch, Path path, std::vector<Position> at, Slot now) {
    constexpr Slot kMargin = 2;
    epoch_ = epoch;
    path_ = std::move(path);
    at_ = std::move(at);
    start_ = rules::start_of(now + machine_.timing.send_ahead_slots + kMargin, slot_);
    made_ = {};
    rests_ = start_;
    slots_over_ = 0;
    sent_ = 0;
    ended_ = late_ = false;
    veto_.reset();
    received_veto_.reset();
    turned_.reset();
    tried_behind_.reset();
    taken_.reset();
    in_flight_.clear();
    endings_.assign(1, Ending{0, path_.moves.front().profile.phases[0].from, at_, false});
}

std::vector<Frame> EpochRunner::send(Slot now, std::span<const AxisView> axes) {
    slots_over_ = now > rules::slot_of(rests_, slot_) ? slots_over_ + 1 : 0;
    FrameNumber held_by_all = sent_;
    for (const AxisView& axis : axes) {
        const bool follows = axis.state && axis.state->epoch == epoch_;
        held_by_all = std::min(held_by_all, follows ? axis.state->held : 0);
        if (follows) { received_veto_ = rules::merge(received_veto_, axis.state->veto); }
    }
    if (received_veto_) { ended_ = true; }  // no axis may run a frame behind it
    try_turn(now);
    std::vector<Frame> frames;
    std::erase_if(in_flight_, [&](const Frame& frame) { return now >= rules::slot_of(frame.start, slot_); });
    for (const Frame& frame : in_flight_) {
        const bool in_time = rules::may_send(now, rules::slot_of(frame.start, slot_), machine_.timing);
        if (in_time && frame.number > held_by_all && !(veto() && *veto() <= frame.number)) { frames.push_back(frame); }
    }
    while (!ended_) {
        const Slot start = rules::slot_of(start_ + made_, slot_);
        if (now < rules::first_send_slot(start, machine_.timing)) { break; }
        if (!rules::may_send(now, start, machine_.timing)) {
            ended_ = late_ = true;
            break;
        }
        try_turn(now);
        frames.push_back(make_frame());
        in_flight_.push_back(frames.back());
    }
    return frames;
}

/// Once behind each frame. A short rest of the path is planned again just before the next frame is made; a long one
/// takes long, and is planned when half a frame's time or more is left until then.
void EpochRunner::try_turn(Slot now) {
    if (!turned_ || ended_ || tried_behind_ == sent_) { return; }
    const Slot due = rules::first_send_slot(rules::slot_of(start_ + made_, slot_), machine_.timing);
    const std::size_t moves_left = path_.moves.size() - path_.move_at(subticks(made_));
    const bool is_time = moves_left <= kPlannedAtOnce ? now >= due : 2 * (due - now) >= machine_.timing.frame_slots;
    if (!is_time) { return; }
    tried_behind_ = sent_;
    if (!replan_from(path_, made_, limits_, bounds_of(machine_), *turned_)) { return; }
    taken_ = Turn{sent_, *turned_};
    turned_.reset();
}

Frame EpochRunner::make_frame() {
    const Ticks whole = path_.duration().ceil();
    const Ticks ticks = std::min(machine_.frame_ticks(), whole - made_);
    Frame frame{.term = {}, .epoch = epoch_, .number = ++sent_, .start = start_ + made_, .ticks = ticks};
    frame.axes.resize(at_.size());
    for (std::size_t i = 0; i < at_.size(); ++i) { frame.axes[i].from = at_[i]; }
    std::vector<Piece> pieces(at_.size());
    PieceSource source(path_, made_, made_ + ticks, at_);
    while (source.next(pieces)) {
        for (std::size_t i = 0; i < pieces.size(); ++i) { frame.axes[i].body.append(pieces[i]); }
    }
    made_ += ticks;
    frame.last = ended_ = made_ == whole;
    endings_.push_back(frame.last ? Ending{path_.moves.size(), {}, at_, true} : fill_tail(frame, made_));
    if (endings_.size() > kEndingsKept) { endings_.pop_front(); }
    for (const AxisTrack& axis : frame.axes) {
        rests_ = std::max(rests_, frame.start + frame.ticks + total_ticks(axis.tail));
    }
    return frame;
}

EpochRunner::Ending EpochRunner::fill_tail(Frame& frame, Ticks end) const {
    const Path tail = brake_from(path_, subticks(end), limits_);
    const std::size_t move = path_.move_at(subticks(end));
    Ending ending{move, path_.moves[move].along_at(subticks(end)), at_, false};
    if (tail.empty()) { return ending; }
    std::vector<Piece> pieces(at_.size());
    PieceSource source(tail, Ticks{0}, tail.duration().ceil(), ending.positions);
    while (source.next(pieces)) {
        for (std::size_t i = 0; i < pieces.size(); ++i) { frame.axes[i].tail.append(pieces[i]); }
    }
    const PathMove& rests_in = tail.moves.back();
    const auto is_it = [&](const PathMove& m) { return m.block == rests_in.block && m.part == rests_in.part; };
    while (!is_it(path_.moves[ending.move])) { ++ending.move; }
    ending.along = tail.moves.back().profile.phases.back().to;
    return ending;
}

void EpochRunner::stop(Slot next) {
    ended_ = true;
    if (veto_) { return; }
    const auto undecided = std::find_if(in_flight_.begin(), in_flight_.end(), [&](const Frame& frame) {
        return rules::coordinator_may_veto(next, rules::slot_of(frame.start, slot_), machine_.timing);
    });
    veto_ = undecided == in_flight_.end() ? sent_ + 1 : undecided->number;
}

std::vector<FrameRest> EpochRunner::rests_from(FrameNumber frame) const {
    std::vector<FrameRest> rests;
    const FrameNumber oldest = sent_ + 1 - endings_.size();
    for (FrameNumber k = std::max(frame, oldest); k <= sent_; ++k) {
        const Ending& ending = endings_[k - oldest];
        const PathMove& move = path_.moves[std::min(ending.move, path_.moves.size() - 1)];
        rests.push_back({k, {move.block, ending.along}, ending.complete, digest_of(ending.positions)});
    }
    return rests;
}

std::optional<EpochEnd> EpochRunner::evaluate(Slot now, std::span<const AxisView> axes) const {
    const Slot first_start = rules::slot_of(start_, slot_);
    std::optional<FrameNumber> ran;
    EpochEnd end;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (!axes[i].present(now, machine_.timing)) { continue; }
        const AxisState& state = *axes[i].state;
        const bool took_part = state.epoch == epoch_;
        const bool settled = state.at_rest && (took_part || state.stamp > first_start + rules::kHopSlots);
        if (!settled) { return std::nullopt; }
        const FrameNumber its = took_part ? state.ran : 0;
        if (ran && *ran != its) {
            end.kind = EpochEnd::Kind::FramesDiffer;
            end.axis = i;
        }
        ran = ran ? std::max(*ran, its) : its;
    }
    const FrameNumber oldest = sent_ + 1 - endings_.size();
    if (!ran || *ran > sent_ || *ran < oldest) { end.kind = EpochEnd::Kind::FramesDiffer; }
    if (end.kind == EpochEnd::Kind::FramesDiffer) { return end; }
    const Ending& ending = endings_[*ran - oldest];
    end = {ending.complete ? EpochEnd::Kind::Complete : EpochEnd::Kind::Interrupted,
           0,
           *ran,
           ending.move,
           ending.along,
           ending.positions};
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (axes[i].present(now, machine_.timing) && axes[i].state->position != ending.positions[i] && *ran > 0) {
            end.kind = EpochEnd::Kind::Misplaced;
            end.axis = i;
        }
    }
    return end;
}

}  // namespace lockstep
