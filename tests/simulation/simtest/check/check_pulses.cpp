#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/kinematics/kinematics.hpp"
#include "tests/simulation/simtest/check/checks.hpp"

namespace lockstep::simtest {
namespace {

constexpr double kPlaceHair = 1e-6;

/// A word of the program: pulses at places, from a place of its course on.
struct Order {
    double from = 0;
    std::int64_t first = 0;  // the motor's count
    std::int64_t every = 0;
    std::int64_t count = 0;
};

/// The orders of an output, in the order of the program. `steps_per_mm`: of its motor, along its axis.
std::vector<Order> orders_of(const Course& course, std::int32_t number, double steps_per_mm) {
    std::vector<Order> orders;
    std::int32_t output = -1;
    double spacing = 0;
    const auto take = [&](const std::vector<ProgramEvent>& events, double from) {
        for (const ProgramEvent& event : events) {
            if (event.kind == ProgramEvent::Kind::PulseSpacing) {
                output = event.index;
                spacing = event.value;
            } else if (event.kind == ProgramEvent::Kind::PulsePlaces) {
                orders.push_back({.from = from,
                                  .first = std::llround(event.value * steps_per_mm),
                                  .every = std::llround(spacing * steps_per_mm),
                                  .count = output == number ? event.index : 0});
            }
        }
    };
    for (std::size_t k = 0; k < course.stretches.size(); ++k) {
        take(course.stretches[k].events, static_cast<double>(k));
    }
    take(course.last_events, course.end());
    return orders;
}

/// Follows the steps of a motor and the notes of its device: each order begins where the program has it, goes on after
/// each rest, and as many pulses are left at each end as steps have not come to its places. A copy follows another
/// reading of a note.
class PulseWalk {
public:
    /// `orders` must stay where they are.
    PulseWalk(std::span<const Order> orders, std::int64_t count) : orders_(orders), count_(count) {}

    /// A step after which the machine is at these places.
    void step(const StepEdge& step, const Reached& places) {
        pass(passed_);
        passed_ = places.first - kPlaceHair;
        note_order_of(places);
        count_ += step.direction;
        if (left_ > 0 && count_ == next_) {
            next_ += orders_[now_].every;
            --left_;
        }
    }
    /// The orders that can begin with a note, at a place up to `last`: behind a rest the one that ended there, or the
    /// one of the next. Of words at one place the last one counts, and also of words between which no step was made.
    std::vector<std::size_t> that_begin(const ChannelEvent& event, double last) const {
        std::vector<std::size_t> orders;
        if (now_ < orders_.size() && rest_ == event.detail && event.tick > ended_) { orders.push_back(now_); }
        for (std::size_t k = now_ < orders_.size() ? now_ + 1 : 0; k < orders_.size(); ++k) {
            const bool is_replaced = k + 1 < orders_.size() && orders_[k + 1].from == orders_[k].from;
            if (is_replaced || orders_[k].count != event.detail || orders_[k].from >= last + kPlaceHair) { continue; }
            orders.push_back(k);
            if (orders_[k].from < passed_) { break; }
        }
        return orders;
    }
    void begin(std::size_t order, const ChannelEvent& event) {
        require(!is_on_, "two orders at a time");
        if (order != now_) { next_ = orders_[order].first; }
        now_ = order;
        left_ = event.detail;
        is_on_ = true;
    }
    void end(const ChannelEvent& event) {
        require(event.detail == left_, "the device says that " + std::to_string(event.detail) +
                                           " pulses are left; by its steps it is " + std::to_string(left_));
        is_on_ = false;
        ended_ = event.tick;
        rest_ = std::exchange(left_, 0);
    }
    const std::string& wrong() const { return wrong_; }
    /// Whether both go on in the same way, after a note with which an order begins.
    bool equals(const PulseWalk& other) const {
        return now_ == other.now_ && next_ == other.next_ && wrong_.empty() == other.wrong_.empty();
    }

private:
    /// Notes the word behind which the step was certainly made, before the next word.
    void note_order_of(const Reached& places) {
        const auto next = std::ranges::upper_bound(orders_, places.first + kPlaceHair, {}, &Order::from);
        if (next == orders_.begin() || (next != orders_.end() && places.last > next->from)) { return; }
        stepped_ = static_cast<std::size_t>(next - orders_.begin()) - 1;
    }
    /// Words before this place have been followed, or no step was made between them and the next word.
    void pass(double place) {
        std::size_t due = now_;
        for (std::size_t k = due < orders_.size() ? due + 1 : 0; k < orders_.size() && orders_[k].from < place; ++k) {
            due = k;
        }
        const bool is_stepped = stepped_ == due;
        if (due == now_ || (is_on_ && !is_stepped)) { return; }
        require(!is_stepped || (orders_[due].count == 0 && !is_on_),
                "the word for " + std::to_string(orders_[due].count) + " pulses was not followed");
        now_ = due;
        rest_ = 0;
    }
    void require(bool holds, const std::string& otherwise) {
        if (!holds && wrong_.empty()) { wrong_ = otherwise; }
    }

    static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    std::span<const Order> orders_;
    std::int64_t count_;
    std::size_t now_ = kNone;      // in orders_
    std::size_t stepped_ = kNone;  // the newest one behind which a step was made
    std::int64_t next_ = 0;        // the place of its next pulse
    std::int64_t left_ = 0;        // while it is on
    std::int64_t rest_ = 0;        // when it ended last
    Tick ended_;
    bool is_on_ = false;
    double passed_ = 0;  // certainly, before the last step: words may be followed a tick late
    std::string wrong_;
};

/// All readings of the notes that are right so far.
class PulseWalks {
public:
    explicit PulseWalks(PulseWalk first) : walks_{std::move(first)} {}

    void step(const StepEdge& step, const Reached& places) {
        for (PulseWalk& walk : walks_) { walk.step(step, places); }
        drop_wrong();
    }
    void note(const ChannelEvent& event, double last) {
        if (event.kind == ChannelEvent::Kind::CompareBegins) {
            begin(event, last);
        } else {
            for (PulseWalk& walk : walks_) { walk.end(event); }
        }
        drop_wrong();
    }
    /// Empty: a reading is right.
    const std::string& wrong() const { return wrong_; }

private:
    void begin(const ChannelEvent& event, double last) {
        std::vector<PulseWalk> begun;
        for (const PulseWalk& walk : walks_) {
            for (const std::size_t order : walk.that_begin(event, last)) {
                PulseWalk next = walk;
                next.begin(order, event);
                const auto is_same = [&](const PulseWalk& other) { return other.equals(next); };
                if (std::ranges::none_of(begun, is_same)) { begun.push_back(std::move(next)); }
            }
        }
        if (begun.empty() && !walks_.empty()) {
            wrong_ = "no word asks for " + std::to_string(event.detail) + " pulses here";
        }
        walks_ = std::move(begun);
    }
    void drop_wrong() {
        if (walks_.empty()) { return; }
        const std::string last = walks_.back().wrong();
        std::erase_if(walks_, [](const PulseWalk& walk) { return !walk.wrong().empty(); });
        if (walks_.empty()) { wrong_ = last; }
    }

    std::vector<PulseWalk> walks_;
    std::string wrong_;
};

bool may_hide(const Recording& recording, std::size_t motor, const JobRecord& job) {
    return std::ranges::any_of(recording.faults, [&](const VirtualFault& fault) {
        const bool is_hidden = fault.kind == VirtualFault::Kind::Crash || fault.is_of_device();
        return fault.process == motor && is_hidden && fault.at <= job.ended && fault.end() >= job.began;
    });
}

std::vector<ChannelEvent> notes_in(const MotorRecord& motor, const JobRecord& job) {
    std::vector<ChannelEvent> notes;
    for (const ChannelEvent& event : motor.channels) {
        const Tick at = motor.truth({event.tick, 1});
        if (ChannelEvent::is_of_pulses(event.kind) && at >= job.began && at <= job.ended) { notes.push_back(event); }
    }
    return notes;
}

/// Where a motor stands before its first step of a job; nullopt if it makes none. It may make up lost steps before
/// that, in a move of its own.
std::optional<std::int64_t> count_before(const MotorRecord& motor, const JobRecord& job) {
    const auto first = std::ranges::find_if(
        motor.tracks, [&](const Track& track) { return track.commanded >= job.began && track.epoch != 0; });
    return first == motor.tracks.end() ? std::nullopt : std::optional(first->from.count());
}

}  // namespace

Violations check_pulses(const Recording& recording, const Followings& followings) {
    Violations violations;
    const Kinematics kinematics(recording.machine);
    for (const OutputConfig& output : recording.machine.outputs) {
        if (!output.makes_pulses()) { continue; }
        const std::size_t m = motor_named(recording.machine, output.motor).value();
        const double steps_per_mm = 1 / kinematics.axis_mm(kinematics.motors()[m].axis.value(), MotorIndex{m});
        for (std::size_t k = 0; k < recording.jobs.size(); ++k) {
            const JobRecord& job = recording.jobs[k];
            if (job.homing || job.outcome == JobOutcome::Failed || may_hide(recording, m, job)) { continue; }
            if (followings[k]->departure) { continue; }
            const std::vector<Order> orders = orders_of(job.course, output.number, steps_per_mm);
            const auto begin = count_before(recording.motors[m], job);
            if (orders.empty() || !begin) { continue; }
            PulseWalks walk({orders, *begin});
            const std::span<const StepEdge> steps = recording.steps_of(job, m);
            const std::vector<Reached>& places = followings[k]->at_step[m];
            std::size_t n = 0;
            const auto pass_until = [&](std::optional<Tick> tick) {
                for (; n < steps.size() && (!tick || steps[n].tick <= *tick); ++n) { walk.step(steps[n], places[n]); }
            };
            for (const ChannelEvent& note : notes_in(recording.motors[m], job)) {
                pass_until(note.tick);
                walk.note(note, n < steps.size() ? places[n].last : followings[k]->end.last);
            }
            pass_until({});
            if (walk.wrong().empty()) { continue; }
            violations.push_back({"pulses", m, job.began.value, {}, output.name + ": " + walk.wrong()});
        }
    }
    return violations;
}

}  // namespace lockstep::simtest
