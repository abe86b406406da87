#include "core/coordinator/jobs/path_job.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/coordinator/path/program_frames.hpp"

namespace lockstep {

void PathJob::load(const MachineJob& job, const AxisCounts& start) {
    aside_.reset();
    events_.begin();
    begin(job, start);
}

void PathJob::begin(const MachineJob& job, const AxisCounts& start) {
    job_ = job;
    next_ = 0;
    from_ = start;
    progress_ = {};
    positions_.clear();
    leg_done_.reset();
    fruitless_ = 0;
    has_moved_ = false;
}

void PathJob::load_return(const MachineJob& back, const AxisCounts& start) {
    aside_ = {job_, has_moved_, next_, from_, progress_};
    begin(back, start);
}

/// A job in its pause continues with its next leg, so nothing else has to be restored.
void PathJob::take_up() {
    if (!aside_) { return; }
    job_ = std::move(aside_->job);
    has_moved_ = aside_->has_moved;
    next_ = aside_->next;
    from_ = aside_->from;
    progress_ = aside_->progress;
    aside_.reset();
}

void PathJob::load(const MachineJob& job, const JobRest& rest, double progress, std::uint32_t events_from) {
    load(job, rest.from);
    events_.begin(events_from);
    next_ = rest.first;
    progress_ = PathProgress(progress);
    resume_ = rest.place;
    positions_ = rest.positions;
    leg_done_ = rest.done;
    if (leg_done_) { return; }
    load_leg();
    runner_.source()->begin_events_from(events_from);
}

/// Makes the frames of the next leg in the memory of the last leg, if its source can do that.
void PathJob::load_leg() {
    const OwnedSource& source = runner_.source();
    const bool has_begun = source && source->begin(job_.program, job_.program->places(), next_, from_);
    if (!has_begun) { runner_.load(planner_.frames(job_.program, next_, from_)); }
}

/// Returns the end of the leg that begins with the next block if nothing moves in it. Returns nullopt if something
/// moves, or if a bounded search does not find its end.
std::optional<LegEnd> PathJob::end_of_empty_leg() const {
    LegEnd end{.block = next_, .to = from_};
    for (; end.block < next_ + ProgramFrames::kBlocksAtOnce; ++end.block) {
        if (job_.program->ends_before(end.block)) { return end; }
        const Block* const block = job_.program->block(end.block);
        if (block == nullptr) { return std::nullopt; }
        end.kind = end_by(*block);
        if (ends_leg(*block)) { return end; }
        if (planner_.moves(*block, job_.program->places(), end.to)) { return std::nullopt; }
    }
    return std::nullopt;
}

/// Returns true if the machine pauses after the leg.
bool PathJob::pass_leg(const LegEnd& end) {
    next_ = end.kind == LegEnd::Kind::Program ? end.block : end.block + 1;
    from_ = end.to;
    pause_ = end.pause;
    return end.kind == LegEnd::Kind::Pause;
}

/// Publishes the events of a leg in which nothing moves, or those at the end of a leg that another coordinator has run.
void PathJob::pass_events(const LegEnd& end, CoordinatorLoop& loop) {
    for (std::uint32_t k = std::max(next_, events_.from()); k < end.block; ++k) {
        const Block* const block = job_.program->block(k);
        if (block == nullptr) { break; }
        const auto* event = std::get_if<ProgramEvent>(&block->action);
        if (event != nullptr) { events_.pass(PathEvent{k, block->line, *event}, of(), loop); }
    }
}

PathJob::Next PathJob::begin_leg(CoordinatorLoop& loop) {
    while (!job_.program->ends_before(next_)) {
        const auto empty = end_of_empty_leg();
        if (!empty) { break; }
        pass_events(*empty, loop);
        if (pass_leg(*empty)) { return Next::Pauses; }
    }
    if (job_.program->ends_before(next_)) { return Next::IsDone; }
    load_leg();
    resume_ = {next_, {}};
    begin_epoch(positions_of(from_), loop);
    return Next::Moves;
}

PathJob::Next PathJob::end_leg(CoordinatorLoop& loop) {
    const bool is_inherited = leg_done_.has_value();
    const LegEnd end = leg_done_ ? *std::exchange(leg_done_, std::nullopt) : runner_.source()->end();
    if (is_inherited) { pass_events(end, loop); }
    return pass_leg(end) ? Next::Pauses : begin_leg(loop);
}

PathJob::Next PathJob::go_on(CoordinatorLoop& loop) {
    if (leg_done_) { return end_leg(loop); }
    begin_epoch(std::exchange(positions_, {}), loop);
    return Next::Moves;
}

/// Returns an epoch greater than any of this term that an axis has accepted from any sender.
Epoch PathJob::next_epoch(const CoordinatorLoop& loop) {
    epoch_ = std::max(epoch_, first_epoch(loop.term));
    for (const AxisView& view : loop.axes.views()) {
        if (view.state && is_epoch_of(view.state->epoch, loop.term)) { epoch_ = std::max(epoch_, view.state->epoch); }
    }
    return ++epoch_;
}

/// If `at` is empty, the epoch begins from rest on whole steps, where the axes stand.
void PathJob::begin_epoch(AxisPositions at, CoordinatorLoop& loop) {
    leg_done_.reset();
    for (std::size_t i = at.size(); i < loop.axes.size(); ++i) {
        at.append(Position::steps(loop.axes.state(i)->position.count()));
    }
    planned_ = overrides_;
    has_moved_ = true;
    runner_.begin(next_epoch(loop), resume_, at, planned_);
    is_moving_ = true;
    has_started_ = false;
    loop.enter(MachinePhase::Running);
}

/// Reports the epoch's start as soon as its first frame can be made.
void PathJob::note_start(CoordinatorLoop& loop) {
    if (has_started_ || !runner_.start()) { return; }
    has_started_ = true;
    for (const PathEvent& event : runner_.source()->events_before(resume_.block)) { events_.pass(event, of(), loop); }
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
    for (const EpochRunner::Happened& event : runner_.take_events(loop.now, loop.axes.views())) {
        events_.happen(event.event, event.tick, of(), loop);
    }
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

/// The axes have passed the places of all events before the block in which they rest.
void PathJob::end_epoch(const EpochEnd& end, CoordinatorLoop& loop) {
    is_moving_ = false;
    const bool knows_place = end.kind == EpochEnd::Kind::Complete || end.kind == EpochEnd::Kind::Interrupted;
    const bool is_whole = end.kind == EpochEnd::Kind::Complete;
    if (knows_place) {
        const std::uint32_t before = is_whole ? runner_.source()->end().block : end.place.block;
        for (const PathEvent& event : runner_.source()->events_before(before)) { events_.pass(event, of(), loop); }
    }
    progress_.end_path(subticks(runner_.ticks_of(end.ran)));
}

void PathJob::interrupt(const EpochEnd& end) {
    resume_ = end.place;
    positions_ = end.positions;
    if (end.ran > 0) { fruitless_ = 0; }
}

bool PathJob::may_try_again(const EpochEnd& end) {
    fruitless_ += end.ran == 0 ? 1 : 0;
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

/// Considers the feed override, but not that the axes' limits may allow less than the feed.
double PathJob::seconds_left(const PathPlace& place) const {
    return runner_.source()->seconds_from(place) / overrides_.feed();
}

void PathJob::note_progress(const CoordinatorLoop& loop) {
    const double ticks = seconds_left(runner_.place_at(loop.now)) * loop.machine.ticks_per_second();
    progress_.note(into_path(loop.now), subticks(Ticks{std::llround(ticks)}));
    job_.program->release_before(runner_.place_at(loop.now).block);
}

void PathJob::report_epoch(MachineState& state) const {
    state.epoch = runner_.epoch();
    state.sent = runner_.sent();
    state.veto = runner_.veto();
    state.overrides = overrides_;
    state.devices = events_.devices();
    state.events_from = events_.from();
}

void PathJob::report_progress(MachineState& state) const {
    const PathPlace place = runner_.place_at(state.tick);
    state.line = runner_.source()->line_of(place.block);
    state.remaining_s = seconds_left(place);
    state.progress = progress_.share();
    if (aside_) {
        state.remaining_s += aside_->job.program->seconds_from({aside_->next, {}}) / overrides_.feed();
        state.progress = aside_->progress.share();
    }
    state.lacks_blocks = runner_.source()->lacks_blocks();
}

void PathJob::report_held(MachineState& state) const {
    state.line = runner_.source()->line_of(resume_.block);
    state.remaining_s = seconds_left(resume_);
    state.progress = progress_.share();
}

/// The program may have paused before anything moved, so that no leg is loaded.
void PathJob::report_paused(MachineState& state) const {
    const Block* const pause = next_ > 0 ? job_.program->block(next_ - 1) : nullptr;
    if (pause != nullptr) { state.line = pause->line; }
    state.remaining_s = job_.program->seconds_from({next_, {}}) / overrides_.feed();
    state.progress = progress_.share();
}

/// The LAI method plans a block in parts, and a place on the program does not say in which part it is. No other
/// coordinator continues a return.
void PathJob::report_rests(MachineState& state, const AxisRoster& axes) const {
    if (!knows_places_ || aside_) { return; }
    FrameNumber oldest = runner_.sent();
    for (const AxisView& view : axes.views()) {
        const bool follows = view.state && view.state->epoch == runner_.epoch();
        oldest = std::min(oldest, follows ? view.state->ran : 0);
    }
    state.job_kind = job_.kind;
    state.program = job_.program_id;
    runner_.list_rests(oldest, state.rests);
}

}  // namespace lockstep
