#include "tests/simulation/simtest/record/motions.hpp"

#include <algorithm>
#include <utility>

namespace lockstep::simtest {
namespace {

Tick ended(const Track& track) { return track.start + track.ticks; }

/// The last step in (after, until], in the device's time; `after` if there is none.
Tick last_step(const MotorRecord& axis, Tick after, std::optional<Tick> until) {
    Tick last = after;
    for (const StepEdge& step : axis.steps) {
        if (step.tick > after && (!until || step.tick <= *until)) { last = step.tick; }
    }
    return last;
}

/// The sender of the frame; for a move of the axis on its own, the owner that it followed.
Term writer_of(const Recording& recording, std::size_t axis, Epoch epoch, Tick at) {
    const auto sent = recording.epochs.find(epoch);
    return sent == recording.epochs.end() ? recording.motors[axis].followed_at(at).term : sent->second.writer;
}

/// A motion that was cut short ends with its last step before the next motion begins.
Motion motion_of(const Recording& recording, std::size_t i, std::size_t n) {
    const MotorRecord& axis = recording.motors[i];
    const Track& track = axis.tracks[n];
    Motion motion{.axis = i, .begin = track.commanded, .end = track.commanded + track.commanded_ticks};
    if (track.cut) {
        const bool more = n + 1 < axis.tracks.size();
        const Tick until = more ? std::min(ended(track), axis.tracks[n + 1].start) : ended(track);
        motion.end = motion.begin + (last_step(axis, track.start, until) - track.start);
    }
    motion.writer = writer_of(recording, i, track.epoch, motion.begin);
    motion.track = &track;
    return motion;
}

/// An unreported motion, known by its steps only. Returns nullopt if no step was made.
std::optional<Motion> motion_of(const Recording& recording, std::size_t i, const LostRun& lost) {
    const MotorRecord& axis = recording.motors[i];
    const Tick from = lost.tracks == 0 ? axis.power_up : ended(axis.tracks[lost.tracks - 1]);
    const bool more = lost.tracks < axis.tracks.size();
    const Tick to = last_step(axis, from, more ? std::optional(axis.tracks[lost.tracks].start) : std::nullopt);
    if (to == from) { return std::nullopt; }
    Motion motion{.axis = i, .begin = lost.at, .end = std::max(lost.at, axis.truth({to, 1}))};
    motion.writer = writer_of(recording, i, lost.epoch, lost.at);
    return motion;
}

}  // namespace

std::vector<Motion> motions_of(const Recording& recording) {
    std::vector<Motion> motions;
    for (std::size_t i = 0; i < recording.motors.size(); ++i) {
        for (std::size_t n = 0; n < recording.motors[i].tracks.size(); ++n) {
            motions.push_back(motion_of(recording, i, n));
        }
        const LostRun* before = nullptr;
        for (const LostRun& lost : recording.motors[i].lost) {
            // The process ended again, or lacked its device, before it reported a motion. The motion belongs to the
            // first loss.
            const LostRun* last = std::exchange(before, &lost);
            const bool is_known = last != nullptr && last->tracks == lost.tracks;
            if (is_known) { continue; }
            if (const auto motion = motion_of(recording, i, lost)) { motions.push_back(*motion); }
        }
    }
    std::ranges::stable_sort(motions, {}, &Motion::begin);
    return motions;
}

}  // namespace lockstep::simtest
