#include "core/coordinator/jobs/path_job.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/motion/interpolate.hpp"

namespace lockstep {

void PathJob::load(const MachineJob& job, std::vector<Leg> legs) {
    job_ = job;
    legs_ = std::move(legs);
    leg_ = 0;
    progress_ = {};
    remaining_.clear();
    positions_.clear();
    fruitless_ = 0;
    time_legs();
}

void PathJob::load(const MachineJob& job, JobRest rest, double progress) {
    job_ = job;
    legs_ = std::move(rest.legs);
    leg_ = rest.leg;
    progress_ = PathProgress(progress);
    resume_ = rest.place;
    remaining_ = std::move(rest.remaining);
    positions_ = std::move(rest.positions);
    fruitless_ = 0;
    time_legs();
}

/// How long the legs behind the next one are planned to last: that one is planned when it begins.
void PathJob::time_legs() {
    for (std::size_t i = leg_ + 1; i < legs_.size(); ++i) {
        Leg& leg = legs_[i];
        if (!leg.moves.empty()) { leg.duration = planner_.path(leg.moves, {}, overrides_).duration(); }
    }
}

PathJob::Next PathJob::begin_leg(CoordinatorLoop& loop) {
    while (leg_ < legs_.size() && legs_[leg_].moves.empty() && !legs_[leg_].then_pause) { ++leg_; }
    if (leg_ == legs_.size()) { return Next::IsDone; }
    const Leg& leg = legs_[leg_];
    if (leg.moves.empty()) {
        ++leg_;
        return Next::Pauses;
    }
    begin_epoch(leg.moves, {leg.moves.front().block, {}}, {}, loop);
    return Next::Moves;
}

PathJob::Next PathJob::end_leg(CoordinatorLoop& loop) {
    const bool pauses = legs_[leg_].then_pause;
    ++leg_;
    return pauses ? Next::Pauses : begin_leg(loop);
}

PathJob::Next PathJob::go_on(CoordinatorLoop& loop) {
    if (remaining_.empty()) { return end_leg(loop); }
    begin_epoch(std::move(remaining_), resume_, std::move(positions_), loop);
    return Next::Moves;
}

/// Greater than any epoch of this term that an axis has accepted, whoever sent it.
Epoch PathJob::next_epoch(const CoordinatorLoop& loop) {
    epoch_ = std::max(epoch_, first_epoch(loop.term));
    for (const AxisView& view : loop.axes.views()) {
        if (view.state && is_epoch_of(view.state->epoch, loop.term)) { epoch_ = std::max(epoch_, view.state->epoch); }
    }
    return ++epoch_;
}

/// `at` empty: from rest on whole steps, where the axes stand.
void PathJob::begin_epoch(std::vector<PathMove> moves, PathPlace place, std::vector<Position> at,
                          CoordinatorLoop& loop) {
    Path path = planner_.path(std::move(moves), place.along, overrides_);
    if (at.empty()) {
        for (std::size_t i = 0; i < loop.axes.size(); ++i) {
            at.push_back(start_of(path, i, loop.axes.state(i)->position.count()));
        }
    }
    const Epoch epoch = next_epoch(loop);
    runner_.begin(epoch, std::move(path), std::move(at), loop.slot);
    is_moving_ = true;
    loop.enter(MachinePhase::Running);
    loop.notice({CoordinatorNotice::Kind::EpochBegun, FaultCode::None, epoch});
    loop.out.jobs.push_back({.kind = JobEvent::Kind::EpochBegun,
                             .job = job_.number,
                             .job_kind = job_.kind,
                             .epoch = epoch,
                             .start = runner_.start(),
                             .place = place,
                             .overrides = overrides_});
}

std::optional<EpochEnd> PathJob::advance(CoordinatorLoop& loop) {
    loop.out.frames = runner_.send(loop.slot, loop.axes.views());
    for (Frame& frame : loop.out.frames) { frame.term = loop.term; }
    if (const auto turn = runner_.take_turn()) {
        loop.out.jobs.push_back({.kind = JobEvent::Kind::Overridden,
                                 .job = job_.number,
                                 .job_kind = job_.kind,
                                 .epoch = runner_.epoch(),
                                 .overrides = turn->overrides,
                                 .behind = turn->behind});
    }
    return runner_.evaluate(loop.slot, loop.axes.views());
}

void PathJob::end_epoch(const EpochEnd& end, const MachineConfig& machine) {
    is_moving_ = false;
    const Ticks ran{static_cast<std::int64_t>(end.ran) * machine.frame_ticks().value};
    progress_.end_path(std::min(subticks(ran), runner_.path().duration()));
}

bool PathJob::interrupt(const EpochEnd& end) {
    const auto& moves = runner_.path().moves;
    const bool move_done = end.along >= Displacement::steps(moves[end.move].lead) && moves[end.move].lead != 0;
    const std::size_t first = move_done ? end.move + 1 : end.move;
    remaining_.assign(moves.begin() + static_cast<std::ptrdiff_t>(first), moves.end());
    positions_ = end.positions;
    resume_ = {move_done ? 0 : moves[end.move].block, move_done ? Displacement{} : end.along};
    if (move_done && !remaining_.empty()) { resume_.block = remaining_.front().block; }
    fruitless_ = end.ran == 0 ? fruitless_ + 1 : 0;
    return fruitless_ < kMaxFruitless;
}

/// To plan the legs to come again takes long, and frames are due: their times are estimated in proportion.
void PathJob::turn(const Overrides& overrides, bool in_job) {
    const Overrides before = std::exchange(overrides_, overrides);
    if (is_moving_) { runner_.turn(overrides_); }
    const double slower = static_cast<double>(before.feed_percent) / overrides_.feed_percent;
    for (std::size_t i = leg_ + 1; in_job && i < legs_.size(); ++i) {
        Subticks& duration = legs_[i].duration;
        duration.value = std::llround(static_cast<double>(duration.value) * slower);
    }
}

Subticks PathJob::into_path(Tick now) const {
    return std::clamp(subticks(now - runner_.start()), Subticks{}, runner_.path().duration());
}

/// By what is planned of it now.
Subticks PathJob::left(Tick now) const {
    Subticks left = runner_.path().duration() - into_path(now);
    for (std::size_t i = leg_ + 1; i < legs_.size(); ++i) { left = left + legs_[i].duration; }
    return left;
}

void PathJob::report_epoch(MachineState& state) const {
    state.epoch = runner_.epoch();
    state.sent = runner_.sent();
    state.veto = runner_.veto();
    state.overrides = overrides_;
}

void PathJob::report_progress(MachineState& state, const MachineConfig& machine) const {
    state.line = runner_.path().moves[runner_.path().move_at(into_path(state.tick))].line;
    state.remaining_s = static_cast<double>(left(state.tick).value) / kSubticksPerTick / machine.ticks_per_second();
    state.progress = progress_.share();
}

/// By the LAI method a block is planned in parts, which no place on the program tells apart.
void PathJob::report_rests(MachineState& state, const AxisRoster& axes) const {
    if (!knows_places_) { return; }
    FrameNumber oldest = runner_.sent();
    for (const AxisView& view : axes.views()) {
        const bool follows = view.state && view.state->epoch == runner_.epoch();
        oldest = std::min(oldest, follows ? view.state->ran : 0);
    }
    state.job_kind = job_.kind;
    state.program = job_.program_id;
    state.rests = runner_.rests_from(oldest);
}

}  // namespace lockstep
