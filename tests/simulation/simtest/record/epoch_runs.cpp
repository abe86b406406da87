#include "tests/simulation/simtest/record/epoch_runs.hpp"

#include <algorithm>

#include "tests/simulation/simtest/record/explain.hpp"

namespace lockstep::simtest {
namespace {

std::int64_t pulses_at(Position at) { return static_cast<std::int64_t>((at.raw + (Int128{1} << 63)) >> 64); }

/// When the epoch of a lost run begins. Nothing of the runs before it moves then.
std::optional<Tick> begin_of(const Recording& recording, const LostRun& lost) {
    const auto epoch = recording.epochs.find(lost.epoch);
    if (epoch == recording.epochs.end()) { return std::nullopt; }
    return epoch->second.frames.begin()->second.start;
}

/// The faults that can have affected an epoch, from the creation of its first frame until one slot after the end of its
/// last frame. By then each axis has read this end from its device.
std::vector<VirtualFault> faults_in(const Recording& recording, const SentEpoch& epoch) {
    const ProtocolTiming& t = recording.machine.timing;
    const Ticks slot = recording.machine.slot_ticks();
    const Tick from = epoch.frames.begin()->second.start - slot * (2 * t.send_ahead_slots);
    const SentFrame& last = epoch.frames.rbegin()->second;
    std::vector<VirtualFault> faults;
    for (const VirtualFault& fault : recording.faults) {
        if (fault.at <= last.start + last.ticks + slot && fault.end() >= from) { faults.push_back(fault); }
    }
    return faults;
}

bool is_emergency_in(const Recording& recording, const SentEpoch& epoch) {
    const SentFrame& last = epoch.frames.rbegin()->second;
    const Tick from = epoch.frames.begin()->second.start -
                      recording.machine.slot_ticks() * 2 * recording.machine.timing.send_ahead_slots;
    return std::ranges::any_of(recording.emergencies, [&](const Emergency& e) {
        return e.asked <= last.start + last.ticks && e.rests >= from;
    });
}

/// True: pulses may have ceased anywhere; the net number of steps then proves nothing.
bool may_be_cut(const Recording& recording, const SentEpoch& epoch, std::size_t axis) {
    const SentFrame& last = epoch.frames.rbegin()->second;
    return is_emergency_in(recording, epoch) || epoch.ceases.contains(MotorIndex{axis}) ||
           may_be_stopped(recording, axis, epoch.frames.begin()->second.start, last.start + last.ticks);
}

LastFrame from_steps(const Recording& recording, const LostRun& lost, const SentEpoch& epoch, std::size_t i) {
    const LastFrame any{lost.recorded, lost.armed};
    if (may_be_cut(recording, epoch, i)) { return any; }
    const auto net = unrecorded_steps(recording, i, lost);
    std::optional<LastFrame> found;
    for (FrameNumber k = lost.recorded; k <= lost.armed && (k == 0 || epoch.frames.contains(k)); ++k) {
        if (steps_to_rest(epoch, i, lost.recorded, k) != net) { continue; }
        found = LastFrame{found ? found->low : k, k};
    }
    return found.value_or(any);
}

/// True: the device failed before the end of its last frame; it may have stopped before its axis noticed.
bool has_lost_device(const Recording& recording, const SentEpoch& epoch, std::size_t axis) {
    const std::vector<VirtualFault> faults = faults_in(recording, epoch);
    return std::ranges::any_of(
        faults, [axis](const VirtualFault& fault) { return fault.is_of_device() && fault.process == axis; });
}

/// One fault at a time separates at most its victim. Several faults, or ceasing pulses, may separate any axis.
std::vector<bool> may_differ(const Recording& recording, const SentEpoch& epoch) {
    const std::vector<VirtualFault> faults = faults_in(recording, epoch);
    const std::size_t axes = recording.motors.size();
    const bool several = faults.size() + (recording.lossy() ? 1 : 0) > 1;
    if (several || is_emergency_in(recording, epoch)) { return std::vector<bool>(axes, true); }
    std::vector<bool> may(axes, false);
    for (const VirtualFault& fault : faults) {
        if (const auto victim = may_be_apart(fault, recording.machine)) { may[*victim] = true; }
    }
    return may;
}

/// Of a motor whose pulses cease at a touch: it was cut, perhaps before its first frame. Nobody knows what it would
/// have run otherwise.
bool may_have_ceased(const MotorRecord& motor, Epoch epoch) {
    const auto last = std::ranges::find(motor.tracks.rbegin(), motor.tracks.rend(), epoch, &Track::epoch);
    return last == motor.tracks.rend() || last->cut;
}

/// A motor whose slide is elsewhere because of an earlier fault can hit its limit switch while it is homed.
bool was_stopped(const Recording& recording, Epoch number, const SentEpoch& epoch, std::size_t motor) {
    const auto is_cut = [number](const Track& track) { return track.epoch == number && track.cut; };
    const SentFrame& last = epoch.frames.rbegin()->second;
    return std::ranges::any_of(recording.motors[motor].tracks, is_cut) &&
           may_be_stopped(recording, motor, epoch.frames.begin()->second.start, last.start + last.ticks);
}

EpochRuns runs_of(const Recording& recording, Epoch number, const SentEpoch& epoch) {
    EpochRuns runs{.may_differ = may_differ(recording, epoch)};
    FrameNumber least = epoch.frames.rbegin()->first;
    FrameNumber most = 0;
    for (std::size_t i = 0; i < recording.motors.size(); ++i) {
        const MotorRecord& axis = recording.motors[i];
        LastFrame last;
        for (const Track& track : axis.tracks) {
            if (track.epoch == number) { last.low = last.high = std::max(last.high, track.frame); }
        }
        for (const LostRun& lost : axis.lost) {
            if (lost.epoch == number) { last = from_steps(recording, lost, epoch, i); }
        }
        if (epoch.ceases.contains(MotorIndex{i}) && may_have_ceased(axis, number)) {
            last.high = epoch.frames.rbegin()->first;
        }
        runs.last.push_back(last);
        if (was_stopped(recording, number, epoch, i)) { runs.may_differ[i] = true; }
        runs.lost_device.push_back(has_lost_device(recording, epoch, i));
        least = std::min(least, last.high);
        most = std::max(most, last.low);
    }
    runs.apart = least < most;
    if (runs.apart) { runs.parted = epoch.frames.at(least + 1).start; }
    return runs;
}

}  // namespace

std::optional<std::int64_t> unrecorded_steps(const Recording& recording, std::size_t axis, const LostRun& lost) {
    const MotorRecord& motor = recording.motors[axis];
    const Tick from =
        lost.tracks == 0 ? Tick{} : motor.tracks[lost.tracks - 1].start + motor.tracks[lost.tracks - 1].ticks;
    const bool more = lost.tracks < motor.tracks.size();
    std::optional<Tick> begin;
    std::optional<Tick> end;
    for (const LostRun& other : motor.lost) {
        if (other.tracks != lost.tracks) { continue; }
        if (other.at < lost.at) { begin = begin_of(recording, lost); }
        if (other.at <= lost.at) { continue; }
        end = begin_of(recording, other);
        if (!end) { return std::nullopt; }
        break;
    }
    std::int64_t net = 0;
    for (const StepEdge& step : motor.steps) {
        if (step.tick <= from || (more && step.tick > motor.tracks[lost.tracks].start)) { continue; }
        const Tick truth = motor.truth(step);
        if ((begin && truth <= *begin) || (end && truth > *end)) { continue; }
        net += step.direction;
    }
    return net;
}

std::int64_t steps_to_rest(const SentEpoch& epoch, std::size_t axis, FrameNumber recorded, FrameNumber k) {
    if (k == 0) { return 0; }
    const Share& end = epoch.frames.at(k).shares[axis];
    const Position from =
        recorded == 0 ? epoch.frames.at(1).shares[axis].from : epoch.frames.at(recorded).shares[axis].to;
    return pulses_at(end.rest) - pulses_at(from);
}

std::map<Epoch, EpochRuns> epoch_runs(const Recording& recording) {
    std::map<Epoch, EpochRuns> all;
    for (const auto& [number, epoch] : recording.epochs) { all[number] = runs_of(recording, number, epoch); }
    return all;
}

}  // namespace lockstep::simtest
