#include "core/coordinator/jobs/path_job.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lockstep {

void PathJob::load(const MachineJob& job, std::vector<Leg> legs) {
    job_ = job;
    legs_ = std::move(legs);
    leg_ = 0;
    progress_ = {};
    positions_.clear();
    fruitless_ = 0;
}

void PathJob::load(const MachineJob& job, JobRest rest, double progress) {
    load(job, std::move(rest.legs));
    leg_ = rest.leg;
    progress_ = PathProgress(progress);
    resume_ = rest.place;
    positions_ = std::move(rest.positions);
    if (!rest.leg_done) { runner_.load(planner_.frames(job_.program, legs_[leg_])); }
    is_leg_done_ = rest.leg_done;
}

PathJob::Next PathJob::begin_leg(CoordinatorLoop& loop) {
    while (leg_ < legs_.size() && !legs_[leg_].moves && !legs_[leg_].then_pause) { ++leg_; }
    if (leg_ == legs_.size()) { return Next::IsDone; }
    const Leg& leg = legs_[leg_];
    if (!leg.moves) {
        ++leg_;
        return Next::Pauses;
    }
    runner_.load(planner_.frames(job_.program, leg));
    resume_ = {leg.first, {}};
    std::vector<Position> at;
    for (const std::int64_t count : leg.from) { at.push_back(Position::steps(count)); }
    begin_epoch(std::move(at), loop);
    return Next::Moves;
}

PathJob::Next PathJob::end_leg(CoordinatorLoop& loop) {
    const bool pauses = legs_[leg_].then_pause;
    ++leg_;
    return pauses ? Next::Pauses : begin_leg(loop);
}

PathJob::Next PathJob::go_on(CoordinatorLoop& loop) {
    if (is_leg_done_) { return end_leg(loop); }
    begin_epoch(std::move(positions_), loop);
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
void PathJob::begin_epoch(std::vector<Position> at, CoordinatorLoop& loop) {
    is_leg_done_ = false;
    for (std::size_t i = at.size(); i < loop.axes.size(); ++i) {
        at.push_back(Position::steps(loop.axes.state(i)->position.count()));
    }
    planned_ = overrides_;
    runner_.begin(next_epoch(loop), resume_, std::move(at), planned_);
    is_moving_ = true;
    has_started_ = false;
    loop.enter(MachinePhase::Running);
}

/// Its first frame can be made.
void PathJob::note_start(CoordinatorLoop& loop) {
    if (has_started_ || !runner_.start()) { return; }
    has_started_ = true;
    loop.notice({CoordinatorNotice::Kind::EpochBegun, FaultCode::None, runner_.epoch()});
    loop.out.jobs.push_back({.kind = JobEvent::Kind::EpochBegun,
                             .job = job_.number,
                             .job_kind = job_.kind,
                             .epoch = runner_.epoch(),
                             .start = *runner_.start(),
                             .place = resume_,
                             .overrides = planned_});
}

std::optional<EpochEnd> PathJob::advance(CoordinatorLoop& loop) {
    loop.out.frames = runner_.send(loop.slot, loop.axes.views());
    for (Frame& frame : loop.out.frames) { frame.term = loop.term; }
    note_start(loop);
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

void PathJob::end_epoch(const EpochEnd& end) {
    is_moving_ = false;
    progress_.end_path(subticks(runner_.ticks_of(end.ran)));
}

bool PathJob::interrupt(const EpochEnd& end) {
    resume_ = end.place;
    positions_ = end.positions;
    fruitless_ = end.ran == 0 ? fruitless_ + 1 : 0;
    return fruitless_ < kMaxFruitless;
}

void PathJob::turn(const Overrides& overrides) {
    overrides_ = overrides;
    if (is_moving_) { runner_.turn(overrides_); }
}

Subticks PathJob::into_path(Tick now) const {
    if (!runner_.start()) { return {}; }
    return subticks(std::clamp(now - *runner_.start(), Ticks{}, runner_.ticks_of(runner_.sent())));
}

/// As the feed override makes it. What the axes' limits make of a feed above them is not counted.
double PathJob::seconds_left(Tick now) const {
    double seconds = runner_.source()->seconds_from(runner_.place_at(now));
    for (std::size_t i = leg_ + 1; i < legs_.size(); ++i) { seconds += legs_[i].times->seconds(); }
    return seconds / overrides_.feed();
}

void PathJob::note_progress(const CoordinatorLoop& loop) {
    const double ticks = seconds_left(loop.now) * loop.machine.ticks_per_second();
    progress_.note(into_path(loop.now), subticks(Ticks{std::llround(ticks)}));
}

void PathJob::report_epoch(MachineState& state) const {
    state.epoch = runner_.epoch();
    state.sent = runner_.sent();
    state.veto = runner_.veto();
    state.overrides = overrides_;
}

void PathJob::report_progress(MachineState& state) const {
    state.line = job_.program->blocks[runner_.place_at(state.tick).block].line;
    state.remaining_s = seconds_left(state.tick);
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
