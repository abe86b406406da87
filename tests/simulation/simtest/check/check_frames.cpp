#include <algorithm>
#include <limits>

#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/record/epoch_runs.hpp"
#include "tests/simulation/simtest/record/explain.hpp"

namespace lockstep::simtest {
namespace {

class FrameCheck {
public:
    FrameCheck(const Recording& recording, Violations& violations) : recording_(recording), violations_(violations) {}

    void check() {
        for (const auto& [number, epoch] : recording_.epochs) {
            check_sent(epoch.frames);
            if (!epoch.ceases.empty()) { check_others_rest(epoch.ceases, epoch.frames); }
        }
        for (std::size_t i = 0; i < recording_.motors.size(); ++i) { check_axis(i); }
        check_same();
    }

private:
    /// Frames are numbered from 1 without gaps. Each begins where the previous one ends; only the newest can be the
    /// last.
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

    /// Motors whose pulses may cease leave no other motor on its path. An axis that rests beyond its travel, because
    /// its motors rest on whole steps, returns with any move.
    void check_others_rest(MotorSet ceasing, const std::map<FrameNumber, SentFrame>& frames) {
        for (const auto& [number, frame] : frames) {
            for (std::size_t i = 0; i < frame.shares.size(); ++i) {
                const Share& share = frame.shares[i];
                const Displacement way = share.rest - frames.begin()->second.shares[i].from;
                const bool moves = way > Displacement::steps(2) || way < Displacement::steps(-2);
                if (!moves || ceasing.contains(MotorIndex{i})) { continue; }
                object(i, frame.start, "moves, while the pulses of other motors may cease");
            }
        }
    }

    void check_axis(std::size_t i) {
        const auto& tracks = recording_.motors[i].tracks;
        const auto& steps = recording_.motors[i].steps;
        std::size_t step = 0;
        for (std::size_t n = 0; n < tracks.size(); ++n) {
            const Track& track = tracks[n];
            if (track.epoch != 0) { check_track(i, track, n == 0 ? nullptr : &tracks[n - 1]); }
            // A track that was cut short ends when the next one begins.
            Tick end = track.start + track.ticks;
            if (n + 1 < tracks.size() && tracks[n + 1].start < end) {
                end = tracks[n + 1].start;
                if (!track.cut) { object(i, end, "two tracks at a time"); }
            }
            check_between(i, n, step, track.start);
            std::int64_t net = 0;
            for (; step < steps.size() && steps[step].tick <= end; ++step) { net += steps[step].direction; }
            if (net != track.net_steps && !track.cut) {
                object(i, track.start, "the steps made are not those of the track");
            }
        }
        check_between(i, tracks.size(), step, Tick{std::numeric_limits<std::int64_t>::max()});
    }

    /// All steps belong to a track. The exception: after the end of its process, a device runs its armed frames and
    /// a tail on its own.
    void check_between(std::size_t i, std::size_t tracks, std::size_t& step, Tick until) {
        const MotorRecord& axis = recording_.motors[i];
        const std::size_t first = step;
        while (step < axis.steps.size() && axis.steps[step].tick <= until) { ++step; }
        const auto of_these = [&](const LostRun& lost) { return lost.tracks == tracks; };
        if (step != first && std::ranges::none_of(axis.lost, of_these)) {
            object(i, axis.steps[first].tick, "steps outside any track");
        }
        for (const LostRun& lost : axis.lost) {
            if (of_these(lost)) { check_lost(i, lost); }
        }
    }

    void check_lost(std::size_t i, const LostRun& lost) {
        const MotorRecord& axis = recording_.motors[i];
        const Tick over = lost.tracks < axis.tracks.size() ? axis.tracks[lost.tracks].commanded : recording_.ended;
        const bool stopped = !recording_.emergencies.empty() || may_be_stopped(recording_, i, lost.at, over);
        if (lost.epoch == 0 || stopped) { return; }
        const SentEpoch& epoch = recording_.epochs.at(lost.epoch);
        const auto net = unrecorded_steps(recording_, i, lost);
        if (!net || epoch.ceases.contains(MotorIndex{i})) { return; }
        for (FrameNumber k = lost.recorded; k <= lost.armed; ++k) {
            if (steps_to_rest(epoch, i, lost.recorded, k) == *net) { return; }
        }
        object(i, lost.at, "steps after the end of the process that do not match an armed frame and its tail");
    }

    /// Frame bodies run in order from 1, as sent and armed. A tail follows its body; it is the last track of its epoch.
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
            object(i, track.start, "there is a gap between frames");
        }
        const auto epoch = recording_.epochs.find(track.epoch);
        if (epoch == recording_.epochs.end() || !epoch->second.frames.contains(track.frame)) {
            return object(i, track.start, "a frame that was never sent");
        }
        const SentFrame& sent = epoch->second.frames.at(track.frame);
        if (!track.tail && (track.commanded != sent.start || track.commanded_ticks != sent.ticks)) {
            object(i, track.start, "frame " + text(track.frame) + " ran at another time than it was sent for");
        }
        const bool asked = std::ranges::any_of(recording_.emergencies, [&](const Emergency& e) {
            const Tick end = track.commanded + track.commanded_ticks + track.clock_error;  // by its own clock at most
            return track.commanded - track.clock_error <= e.rests && end >= e.asked;
        });
        const bool stopped = may_be_stopped(recording_, i, track.commanded, track.commanded + track.commanded_ticks);
        const bool may_cease = epoch->second.ceases.contains(MotorIndex{i});
        if (track.cut && !asked && !stopped && !may_cease) { object(i, track.start, "a frame was cut short"); }
    }

    /// All axes ran the same frames, except those that a fault may have separated. No two axes are apart by more than
    /// most_apart().
    void check_same() {
        for (const auto& [number, runs] : epoch_runs(recording_)) {
            if (!runs.apart) { continue; }
            std::vector<std::size_t> together;
            for (std::size_t i = 0; i < runs.last.size(); ++i) {
                if (!runs.may_differ[i]) { together.push_back(i); }
            }
            for (const std::size_t i : together) {
                const LastFrame &a = runs.last[together.front()], &b = runs.last[i];
                if (a.low > b.high || b.low > a.high) {
                    object(i, runs.parted, "the axis ran other frames than the others");
                }
            }
            check_distance(runs);
            check_reported(number, *runs.parted);
        }
    }

    void check_distance(const EpochRuns& runs) {
        FrameNumber least = std::numeric_limits<FrameNumber>::max(), most = 0;
        for (std::size_t i = 0; i < runs.last.size(); ++i) {
            if (runs.lost_device[i]) { continue; }
            least = std::min(least, runs.last[i].high);
            most = std::max(most, runs.last[i].low);
        }
        if (most > 0 && most > least + most_apart()) {
            object({}, runs.parted, "axes more than " + text(most_apart()) + " frames apart");
        }
    }

    /// If a device stops, or a switch or the emergency stop's input stops it, its axis vetoes what begins four slots
    /// after its next state, which comes a slot or two later. If the axis stalls as well, the others run all frames for
    /// which they have evidence, up to the lease. So does the device of a process that meanwhile has ended or receives
    /// nothing.
    FrameNumber most_apart() const {
        using Kind = VirtualFault::Kind;
        const ProtocolTiming& t = recording_.machine.timing;
        const auto any = [&](const auto& is) { return std::ranges::any_of(recording_.faults, is); };
        const bool stalls =
            any([](const VirtualFault& fault) { return fault.kind == Kind::Freeze || fault.kind == Kind::StopDevice; });
        const auto is_away = [](const VirtualFault& fault) {
            return fault.kind == Kind::Crash || fault.kind == Kind::Cut;
        };
        const bool is_stopped =
            recording_.was_stop_pressed() || any([](const VirtualFault& fault) { return fault.is_of_plant(); });
        const bool knows_no_veto = any(is_away) && is_stopped;
        const Slot slots = stalls || knows_no_veto ? t.lease_slots() : rules::kLastCheckSlots + 1;
        return static_cast<FrameNumber>(1 + slots / t.frame_slots);
    }

    /// If axes ran different frames, their coordinator enters Fault before it begins another epoch.
    void check_reported(Epoch number, Tick parted) {
        const auto next = recording_.epochs.upper_bound(number);
        const bool goes_on =
            next != recording_.epochs.end() && next->second.writer == recording_.epochs.at(number).writer;
        if (!goes_on) { return; }
        const Tick until = next->second.frames.begin()->second.start;
        const Ticks early = recording_.machine.slot_ticks() * 2 * recording_.machine.timing.send_ahead_slots;
        const bool reported = std::ranges::any_of(recording_.machine_faults,
                                                  [&](Tick tick) { return tick >= parted - early && tick <= until; });
        if (!reported) { object({}, parted, "axes ran different frames, and the machine continues without a Fault"); }
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
