#include "tests/simulation/simtest/record/recording.hpp"

#include <algorithm>
#include <cmath>

#include "tests/simulation/simtest/record/explain.hpp"
#include "tests/simulation/simtest/record/slide.hpp"

namespace lockstep::simtest {
namespace {

/// A piece of n ticks from speed register v with acceleration a covers n v + a n (n + 1) / 2.
Int128 gone(const Piece& piece) {
    const Int128 n = piece.ticks.value;
    return n * piece.velocity.raw + n * (n + 1) / 2 * piece.acceleration.raw;
}

/// One pulse for every half step passed upwards.
std::int64_t pulses_at(Int128 raw) { return static_cast<std::int64_t>((raw + (Int128{1} << 63)) >> 64); }

Track track_of(const ExecutedTrack& executed, FrameNumber armed) {
    Track track{.epoch = executed.epoch, .frame = executed.frame, .tail = executed.tail, .start = executed.start};
    Int128 at = executed.from.raw;
    for (const Piece& piece : executed.pieces) {
        track.ticks += piece.ticks;
        at += gone(piece);
    }
    track.from = executed.from;
    track.to = {at};
    track.net_steps = pulses_at(at) - pulses_at(executed.from.raw);
    track.cut = executed.cut;
    track.armed = armed;
    track.commanded = executed.commanded_start;
    for (const Ticks ticks : executed.commanded_ticks) { track.commanded_ticks += ticks; }
    track.clock_error = executed.clock_error;
    if (executed.commanded_ticks.empty()) { track.commanded_ticks = track.ticks; }
    return track;
}

}  // namespace

std::vector<std::int64_t> Recording::slide_ways(const JobRecord& job, std::size_t motor) const {
    Slide slide(motors[motor].play);
    const auto all = std::span(motors[motor].steps);
    for (const StepEdge& step : all.first(job.first_step[motor])) { (void)slide.take(step.direction); }
    std::vector<std::int64_t> ways;
    for (const StepEdge& step : steps_of(job, motor)) { ways.push_back(slide.take(step.direction)); }
    return ways;
}

std::uint64_t Recording::steps() const {
    std::uint64_t sum = 0;
    for (const MotorRecord& axis : motors) { sum += axis.steps.size(); }
    return sum;
}

/// FNV-1a over whole words.
std::uint64_t Recording::hash() const {
    std::uint64_t hash = 0xcbf29ce484222325U;
    const auto take = [&hash](std::uint64_t word) { hash = (hash ^ word) * 0x100000001b3U; };
    for (const MotorRecord& axis : motors) {
        take(axis.steps.size());
        for (const StepEdge& step : axis.steps) {
            take(static_cast<std::uint64_t>(step.tick.value) * 2 + (step.direction > 0 ? 1 : 0));
        }
    }
    return hash;
}

Tick MotorRecord::truth(const StepEdge& step) const { return {std::llround(clock.truth(step.tick, power_up))}; }

Ticks MotorRecord::bound_at(Tick truth) const {
    const auto later = std::ranges::upper_bound(bounds, truth, {}, &PublishedBound::at);
    const Ticks published = later == bounds.begin() ? Ticks{} : std::prev(later)->error;
    const auto next = std::ranges::upper_bound(tracks, truth, {}, &Track::commanded);
    const bool in_tail = next != tracks.begin() && std::prev(next)->tail;
    return in_tail ? std::max(published, std::prev(next)->clock_error) : published;
}

Followed MotorRecord::followed_at(Tick truth) const {
    const auto later = std::ranges::upper_bound(followed, truth, {}, &Followed::at);
    return later == followed.begin() ? Followed{} : *std::prev(later);
}

void Recorder::on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& node) {
    if (out.state) { take_state(axis, *out.state, now); }
    for (const ExecutedTrack& executed : out.tracks) {
        recording_.motors[axis].tracks.push_back(track_of(executed, armed_[axis]));
    }
    for (const AxisNotice& notice : out.notices) { take_notice(axis, notice, node); }
    for (const DeviceOrder& order : out.orders) {
        const auto* arm = std::get_if<device::Arm>(&order);
        if (arm != nullptr) { armed_[axis] = std::max(armed_[axis], arm->number); }
    }
    // An axis that does not know the time reports the loss in a later state, if it still lacks the device then.
    bool loses = std::ranges::any_of(out.notices, [](const AxisNotice& notice) {
        return notice.kind == AxisNotice::Kind::Fault && notice.fault == FaultCode::DeviceLost;
    });
    if (out.state) {
        const bool lacks = out.state->unproved == FaultCode::DeviceMissing;
        loses = loses || (lacks && !lacks_device_[axis]);
        lacks_device_[axis] = lacks;
    }
    if (loses) { lose_run(axis, now); }
}

void Recorder::take_state(std::size_t axis, const AxisState& state, Tick now) {
    MotorRecord& record = recording_.motors[axis];
    record.bounds.push_back({now, state.clock_error});
    const Followed last = record.followed_at(now);
    if (last.process == state.identity && last.term == state.term) { return; }
    record.followed.push_back({now, state.identity, state.term});
}

void Recorder::take_notice(std::size_t axis, const AxisNotice& notice, const AxisNode& node) {
    using Kind = AxisNotice::Kind;
    if (notice.kind == Kind::EpochBegun) {
        epoch_[axis] = notice.number;
        armed_[axis] = 0;
    }
    if (notice.kind == Kind::EpochEnded) { epoch_[axis] = 0; }
    const bool explained = explains(recording_, notice.fault);
    const bool refuses = notice.kind == Kind::FrameRefused && recording_.network.corrupted == 0;
    if (refuses || (notice.kind == Kind::Fault && !explained)) {
        recording_.troubles.push_back(motor_name(recording_.machine, MotorIndex{axis}) + ": " +
                                      (refuses ? "frame refused: " : "fault ") + std::string(name_of(notice.fault)) +
                                      " " + node.device().trouble());
    }
}

void Recorder::on_coordinator(std::size_t process, Tick now, const CoordinatorOutputs& out) {
    for (const Frame& frame : out.frames) { keep(frame, now); }
    for (const AxisCommand& order : out.axis_commands) { keep(order, now); }
    for (const CoordinatorNotice& notice : out.notices) { take_notice(process, notice, now); }
    if (out.must_quit) { recording_.troubles.push_back("coordinator: another coordinator is present"); }
}

void Recorder::take_notice(std::size_t process, const CoordinatorNotice& notice, Tick now) {
    using Kind = CoordinatorNotice::Kind;
    if (notice.kind == Kind::EpochBegun) { recording_.epochs_begun.push_back(now); }
    if (notice.kind == Kind::Interrupted) { recording_.interruptions.push_back(now); }
    if (notice.kind == Kind::Claimed) { recording_.claims.push_back({now, process}); }
    if (notice.kind != Kind::Fault) { return; }
    recording_.machine_faults.push_back(now);
    recording_.fault = notice.fault;
    if (!explains(recording_, notice.fault)) {
        recording_.troubles.push_back("coordinator: fault " + std::string(name_of(notice.fault)));
    }
}

void Recorder::on_fault(Tick now, const VirtualFault& fault, bool begins) {
    if (!begins) { return; }
    recording_.faults.push_back(fault);
    const std::size_t i = fault.process;
    if (fault.kind == VirtualFault::Kind::Crash && i < recording_.motors.size()) { lose_run(i, now); }
}

/// From now on no process reports what the device does.
void Recorder::lose_run(std::size_t i, Tick now) {
    MotorRecord& axis = recording_.motors[i];
    const bool some = !axis.tracks.empty() && axis.tracks.back().epoch == epoch_[i];
    axis.lost.push_back({now, axis.tracks.size(), epoch_[i], some ? axis.tracks.back().frame : 0, armed_[i]});
    epoch_[i] = 0;
}

void Recorder::keep(const AxisCommand& order, Tick now) {
    auto& given = recording_.motors[order.axis].orders;
    const bool known = std::ranges::any_of(given, [&](const GivenOrder& g) { return g.order == order; });
    if (!known) { given.push_back({now, order}); }
}

void Recorder::keep(const Frame& frame, Tick now) {
    SentEpoch begun{.writer = frame.term, .first_sent = now, .frames = {}};
    for (const TouchInput& input : frame.touch.any_of) {
        if (frame.touch.ceases) { begun.ceases.insert(input.motor); }
    }
    SentEpoch& epoch = recording_.epochs.try_emplace(frame.epoch, std::move(begun)).first->second;
    if (epoch.writer != frame.term) {
        recording_.troubles.push_back("epoch " + std::to_string(frame.epoch) + " has two writers");
    }
    SentFrame sent{frame.start, frame.ticks, frame.last, {}};
    for (const AxisTrack& track : frame.axes) {
        Share share{track.from, track.from, {}};
        for (const Piece& piece : track.body) { share.to = share.to + Displacement{gone(piece)}; }
        share.rest = share.to;
        for (const Piece& piece : track.tail) { share.rest = share.rest + Displacement{gone(piece)}; }
        sent.shares.push_back(share);
    }
    const auto [kept, first] = epoch.frames.try_emplace(frame.number, sent);
    if (!first && kept->second != sent) {
        recording_.troubles.push_back("coordinator: frame " + std::to_string(frame.number) + " sent in two versions");
    }
}

}  // namespace lockstep::simtest
