#include <algorithm>

#include "tests/simulation/simtest/checks.hpp"

namespace lockstep::simtest {
namespace {

class FrameCheck {
public:
    FrameCheck(const Recording& recording, Violations& violations) : recording_(recording), violations_(violations) {}

    void check() {
        if (recording_.writers.size() > 1) { object({}, {}, "more than one writer of frames"); }
        for (const auto& [epoch, frames] : recording_.frames) { check_sent(frames); }
        for (std::size_t i = 0; i < recording_.axes.size(); ++i) { check_axis(i); }
        check_same();
    }

private:
    /// Numbered from 1 without gaps, each from the end of the one before, only the newest the last.
    void check_sent(const std::map<FrameNumber, SentFrame>& frames) {
        FrameNumber next = 1;
        const SentFrame* before = nullptr;
        for (const auto& [number, frame] : frames) {
            const bool joins = before == nullptr || (frame.start == before->start + before->ticks && !before->last);
            if (number != next || !joins) { object({}, frame.start, "frame " + text(number) + " does not follow"); }
            before = &frame;
            ++next;
        }
    }

    void check_axis(std::size_t i) {
        const auto& tracks = recording_.axes[i].tracks;
        const auto& steps = recording_.axes[i].steps;
        std::size_t step = 0;
        for (std::size_t n = 0; n < tracks.size(); ++n) {
            const Track& track = tracks[n];
            if (track.epoch != 0) { check_track(i, track, n == 0 ? nullptr : &tracks[n - 1]); }
            // One that was cut short is over when the next begins.
            Tick end = track.start + track.ticks;
            if (n + 1 < tracks.size() && tracks[n + 1].start < end) {
                end = tracks[n + 1].start;
                if (!track.cut) { object(i, end, "two tracks at a time"); }
            }
            if (step < steps.size() && steps[step].tick <= track.start) {
                object(i, track.start, "steps outside any track");
            }
            std::int64_t net = 0;
            for (; step < steps.size() && steps[step].tick <= end; ++step) { net += steps[step].direction; }
            if (net != track.net_steps && !track.cut) { object(i, track.start, "other steps made than the track has"); }
        }
        if (step != steps.size()) { object(i, steps[step].tick, "steps outside any track"); }
    }

    /// Bodies from 1 on, as sent and armed; a tail after its body, and nothing of the epoch after it.
    void check_track(std::size_t i, const Track& track, const Track* before) {
        const bool same_epoch = before != nullptr && before->epoch == track.epoch;
        const FrameNumber ran = same_epoch ? before->frame : 0;
        if (!track.tail && track.armed < track.frame) {
            object(i, track.start, "frame " + text(track.frame) + " was not armed");
        }
        if (same_epoch && before->tail) { object(i, track.start, "run after the tail of its epoch"); }
        if (track.frame != ran + (track.tail ? 0 : 1)) {
            object(i, track.start, "frame " + text(track.frame) + " run after frame " + text(ran));
        }
        if (same_epoch && track.start != before->start + before->ticks) {
            object(i, track.start, "a gap between frames");
        }
        const auto epoch = recording_.frames.find(track.epoch);
        if (epoch == recording_.frames.end() || !epoch->second.contains(track.frame)) {
            return object(i, track.start, "a frame that was never sent");
        }
        const SentFrame& sent = epoch->second.at(track.frame);
        if (!track.tail && (track.start != sent.start || track.ticks != sent.ticks)) {
            object(i, track.start, "frame " + text(track.frame) + " run at another time than it was sent for");
        }
        if (track.cut) { object(i, track.start, "a frame was cut short"); }
    }

    /// The highest frame run of each epoch.
    std::map<Epoch, FrameNumber> ran(std::size_t i) const {
        std::map<Epoch, FrameNumber> ran;
        for (const Track& track : recording_.axes[i].tracks) {
            if (track.epoch != 0) { ran[track.epoch] = std::max(ran[track.epoch], track.frame); }
        }
        return ran;
    }

    void check_same() {
        for (std::size_t i = 1; i < recording_.axes.size(); ++i) {
            if (ran(i) != ran(0)) { object(i, {}, "other frames run than axis " + recording_.machine.axes[0].name); }
        }
    }

    static std::string text(FrameNumber number) { return std::to_string(number); }
    void object(std::optional<std::size_t> axis, std::optional<Tick> tick, std::string what) {
        violations_.push_back({"frames", axis, tick ? std::optional(tick->value) : std::nullopt, {}, std::move(what)});
    }

    const Recording& recording_;
    Violations& violations_;
};

}  // namespace

Violations check_frames(const Recording& recording) {
    Violations violations;
    FrameCheck(recording, violations).check();
    return violations;
}

}  // namespace lockstep::simtest
