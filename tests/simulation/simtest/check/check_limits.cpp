#include <algorithm>
#include <cmath>

#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/record/explain.hpp"
#include "tests/simulation/simtest/record/follow.hpp"
#include "tests/simulation/simtest/record/motor_shares.hpp"

namespace lockstep::simtest {
namespace {

constexpr double kRounding = 1 + 1e-5;  // error of rounding doubles to integers
constexpr double kJointTicks = 2;       // two phases of a motion meet at whole ticks: each can be off by one

/// Each end of a window of steps may be off by the deviation of pieces of constant acceleration from the path.
constexpr double kStray_steps = 2 * 0.04;
double least(double steps) { return steps - kStray_steps; }
double most_of(double steps) { return steps + kStray_steps; }

/// A feed may be exceeded by this share of the start velocity: a piece only approximates a changing speed.
constexpr double kFeedShare = 0.005;

/// How a device's own clock changes machine time. The limits of an axis hold in its device's time, including clock
/// corrections; a feed is a speed in machine time.
struct OwnClock {
    double hurry = 1;     // factor of a feed: clock rates differ by 200 ppm, corrections add 500
    double rounding = 1;  // ticks, in the time between two steps; frames end at its whole ticks too
};

OwnClock own_clock(const MachineConfig& machine) {
    return machine.estimates_clocks() ? OwnClock{.hurry = 1 + 700e-6, .rounding = 2} : OwnClock{};
}

struct Limits {
    double start = 0;  // steps per tick
    double top = 0;
    double accel = 0;  // steps per tick^2
    double decel = 0;
};

Limits in_ticks(const MotorShares& map, std::int64_t tick_ns, std::size_t motor) {
    const MotorLimits& limits = map.limits(motor);
    const double tick = static_cast<double>(tick_ns) * 1e-9;
    const double scale = map.steps_per_mm(motor) * tick * kRounding;
    return {limits.start * scale, limits.top * scale, limits.accel * scale * tick, limits.decel * scale * tick};
}

/// The steps of one motor in one job.
class LimitCheck {
public:
    /// `following`: none while homing.
    LimitCheck(const Recording& recording, const Limits& limits, const JobRecord& job, std::size_t axis,
               const Following* following, Violations& violations)
        : limits_(limits),
          steps_(recording.steps_of(job, axis)),
          course_(job.course),
          at_(following == nullptr ? nullptr : &following->at_step[axis]),
          end_(following == nullptr ? Reached{} : following->end),
          // Between two epochs, and between two moves of an axis on its own, the axis rests at least this long.
          least_rest_((job.homing ? 1 : recording.machine.timing.send_ahead_slots) *
                      recording.machine.slot_ticks().value),
          axis_(axis),
          first_(job.first_step[axis]),
          rounding_(own_clock(recording.machine).rounding),
          hurry_(own_clock(recording.machine).hurry),
          ceases_(job.emergency.has_value() || may_be_stopped(recording, axis, job.began, job.ended)),
          violations_(violations) {
        lines_ = lines();
        const Joints joints(job.course, axis);
        for (std::size_t n = 0; n < steps_.size(); ++n) {
            joints_before_.push_back(at_ == nullptr ? 0 : joints.before((*at_)[n].first));
            joints_up_to_.push_back(at_ == nullptr ? 0 : joints.up_to((*at_)[n].last));
        }
        joints_up_to_.push_back(at_ == nullptr ? 0 : joints.up_to(end_.last));
        add_take_ups(recording, job);
        for (const StepEdge& step : steps_) { counts_.push_back(counts_.back() + step.direction); }
    }

    void check() {
        for (std::size_t begin = 0; begin < steps_.size();) {
            std::size_t end = begin + 1;
            while (end < steps_.size() && !may_rest_before(end)) { ++end; }
            check_stretch(begin, end);
            begin = end;
        }
    }

private:
    /// Where a motor takes up its backlash, all others stop, and it begins and ends at once. That is another joint.
    /// The steps of a device that died are not recorded: after them others may stop between any two steps.
    void add_take_ups(const Recording& recording, const JobRecord& job) {
        std::vector<Tick> first, last;
        Tick seen_until = job.ended;
        for (std::size_t m = 0; m < recording.motors.size(); ++m) {
            if (recording.motors[m].play == 0) { continue; }
            const auto steps = recording.steps_of(job, m);
            if (may_be_stopped(recording, m, job.began, job.ended)) {
                seen_until = std::min(seen_until, steps.empty() ? job.began : recording.motors[m].truth(steps.back()));
            }
            const auto ways = recording.slide_ways(job, m);
            for (std::size_t n = 0; n < steps.size(); ++n) {
                if (ways[n] != 0) { continue; }
                const Tick at = recording.motors[m].truth(steps[n]);
                const Ticks error = recording.motors[m].bound_at(at) + recording.motors[axis_].bound_at(at);
                first.push_back(at - error);
                last.push_back(at + error);
            }
        }
        std::ranges::sort(first);
        std::ranges::sort(last);
        for (std::size_t n = 0; n < steps_.size(); ++n) {
            const Tick at = recording.motors[axis_].truth(steps_[n]);
            if (at > seen_until) { ++joints_up_to_[n]; }
            joints_before_[n] += static_cast<std::size_t>(std::ranges::lower_bound(last, at) - last.begin());
            joints_up_to_[n] += static_cast<std::size_t>(std::ranges::upper_bound(first, at) - first.begin());
        }
        joints_up_to_.back() += first.size() + (seen_until < job.ended ? 1 : 0);
    }

    /// Whether the axis may have rested before step n. After a pause it rests at least as long.
    bool may_rest_before(std::size_t n) const {
        const bool turns = at_ == nullptr && steps_[n].direction != steps_[n - 1].direction;
        return turns || (steps_[n].tick - steps_[n - 1].tick).value >= least_rest_;
    }

    /// The number of joints between two steps. The index after the last step is the end of the job.
    std::size_t joints(std::size_t from, std::size_t to) const {
        return joints_up_to_[to] - std::min(joints_before_[from], joints_up_to_[to]);
    }

    /// The joints between a rest in this gap and the step beside it. The start and the end of a motion are not joints.
    std::size_t joints_beside_rest(std::size_t gap) const { return gap == 0 ? joints_up_to_[0] : joints(gap - 1, gap); }

    double time(std::size_t from, std::size_t to) const {
        return static_cast<double>((steps_[to].tick - steps_[from].tick).value);
    }

    /// A forward step to count c is made half a step before c, a backward step half a step after it.
    double distance(std::size_t from, std::size_t to) const {
        return static_cast<double>(counts_[to + 1] - counts_[from + 1]) +
               0.5 * (steps_[from].direction - steps_[to].direction);
    }

    void check_stretch(std::size_t begin, std::size_t end) {
        for (std::size_t m = 1; m < end - begin; m *= 4) {
            check_from_rest(begin, m);
            if (!ceases_ || end < steps_.size()) { check_to_rest(end - 1, end, m); }
            const std::size_t stride = std::max<std::size_t>(1, m / 4);
            for (std::size_t n = begin; n + m < end; n += stride) { check_speed(n, m); }
            for (std::size_t n = begin + m; n + m < end; n += stride) { check_change(n, m); }
        }
    }

    void check_speed(std::size_t n, std::size_t m) {
        if (joints(n, n + m) > 0) { return; }
        const double way = least(std::abs(distance(n, n + m)));
        const double ticks = time(n, n + m) + rounding_;
        check_speed(way / ticks, limits_.top, n, m);
        if (at_ == nullptr) { return; }
        const Asked asked = asked_of(n, n + m);
        const double feed = asked.feed * kRounding * hurry_ + kFeedShare * limits_.start;
        check_speed((way - asked.moved) / ticks, std::min(limits_.top, feed), n, m);
    }
    void check_speed(double speed, double most, std::size_t n, std::size_t m) {
        if (speed > most) { object("speed", n + m, speed, most, m); }
    }

    struct Asked {
        double feed = 0;   // steps per tick
        double moved = 0;  // steps: the move of an arc's end to a whole step, in the same time
    };
    /// The most of all moves that the steps can belong to. Joined moves lead from one direction to the other. With a
    /// wide tolerance an axis can be faster than in both: a parabola within the tolerance of a corner is steeper at its
    /// ends than the lines there.
    Asked asked_of(std::size_t from, std::size_t to) const {
        const std::size_t end = course_.stretches.size();
        const auto first = static_cast<std::size_t>((*at_)[from].first);
        const auto last = static_cast<std::size_t>((*at_)[to].last);
        const std::size_t begin = first < end ? lines_[first].first : end;
        const std::size_t behind = last < end ? lines_[last].last + 1 : end;
        const std::size_t stop = behind < end ? lines_[behind].last + 1 : end;
        Asked most;
        for (std::size_t k = begin > 0 ? lines_[begin - 1].first : 0; k < stop; ++k) {
            const Stretch& stretch = course_.stretches[k];
            const bool is_beside = k < first || k > last;
            if (is_beside && !stretch.is_joined) { continue; }
            most.feed = std::max(most.feed, stretch.fastest[axis_] + lines_[k].steeper);
            if (!stretch.moved.empty()) { most.moved = std::max(most.moved, stretch.moved[axis_]); }
        }
        return most;
    }

    /// The line of a stretch: its first and last part, and how much faster than in it an axis can be.
    struct Line {
        std::size_t first = 0;
        std::size_t last = 0;
        double steeper = 0;
    };

    std::vector<Line> lines() const {
        std::vector<Line> all;
        for (std::size_t first = 0; first < course_.stretches.size();) {
            const std::size_t last = course_.last_part(first);
            all.resize(last + 1, Line{first, last, steeper(first, last)});
            first = last + 1;
        }
        return all;
    }

    /// |x| from -1 to 1 is within 1/8 of x^2 + 1/8, which has twice its slope at the ends.
    double steeper(std::size_t first, std::size_t last) const {
        constexpr double kSlopePerTolerance = 8;
        const Stretch& it = course_.stretches[first];
        if (!it.is_joined || it.tolerance <= 1) { return 0; }
        double ticks = 0;
        for (std::size_t axis = 0; axis < it.to.size(); ++axis) {
            double of_axis = 0;
            for (std::size_t k = first; k <= last; ++k) {
                const double way = std::abs(course_.stretches[k].to[axis] - course_.at(k, axis));
                of_axis += way > 0 ? way / course_.stretches[k].fastest[axis] : 0;
            }
            ticks = std::max(ticks, of_axis);
        }
        return ticks > 0 ? kSlopePerTolerance * it.tolerance / ticks : 0;
    }

    void check_change(std::size_t n, std::size_t m) {
        const double t1 = time(n - m, n);
        const double t2 = time(n, n + m);
        const double between = (t1 + t2 + rounding_) / 2 + kJointTicks;
        const bool may_jump = joints(n - m, n + m) > 0;
        if (may_jump || turns(n - m, n + m)) { return check_change_either_way(n, m, between, may_jump); }
        const double fewest = least(static_cast<double>(m));
        const double most = most_of(static_cast<double>(m));
        const double rises = fewest / (t2 + rounding_) - most / std::max(t1 - rounding_, 1e-3);
        const double falls = fewest / (t1 + rounding_) - most / std::max(t2 - rounding_, 1e-3);
        const double most_rise = limits_.accel * between;
        const double most_fall = limits_.decel * between;
        if (rises > most_rise) { object("acceleration", n, rises, most_rise, m); }
        if (falls > most_fall) { object("deceleration", n, falls, most_fall, m); }
    }

    /// Whether the axis turns between two steps: joined moves can lead it forth and back.
    bool turns(std::size_t from, std::size_t to) const {
        return std::abs(distance(from, to)) < static_cast<double>(to - from);
    }

    /// The jumps of any number of successive joints add up to at most one start velocity.
    void check_change_either_way(std::size_t n, std::size_t m, double between, bool may_jump) {
        struct Mean {
            double low, high;
        };
        const auto mean = [this](std::size_t from, std::size_t to) {
            const double low = least(distance(from, to));
            const double high = most_of(distance(from, to));
            const double shortest = std::max(time(from, to) - 1, 1e-3);
            const double longest = time(from, to) + 1;
            return Mean{low / (low > 0 ? longest : shortest), high / (high > 0 ? shortest : longest)};
        };
        const Mean before = mean(n - m, n);
        const Mean after = mean(n, n + m);
        const double change = std::max(after.low - before.high, before.low - after.high);
        const double most = std::max(limits_.accel, limits_.decel) * between + (may_jump ? limits_.start : 0);
        if (change > most) { object("sudden change", n, change, most, m); }
    }

    /// The first crossing is at most one step from the position of rest. An axis that did not rest, but moved slowly,
    /// can have accelerated over one step. With joints it can be faster by one more start velocity. From the crossing
    /// back into the gap its speed is at least a line that is lower by this, and the line covers less than a step.
    double speed_beside_rest(std::size_t gap, double rate) const {
        const bool between = gap > 0 && gap < steps_.size();
        const double slow = between ? 1 / (time(gap - 1, gap) - rounding_) : 0;
        if (joints_beside_rest(gap) > 0) {
            return limits_.start + std::sqrt(slow * slow + 2 * std::max(limits_.accel, limits_.decel));
        }
        const double slowest = std::max(limits_.start, slow);
        return std::sqrt(slowest * slowest + 2 * rate);
    }
    void check_from_rest(std::size_t begin, std::size_t m) {
        check_ramp("start", begin, begin, m, speed_beside_rest(begin, limits_.accel), limits_.accel);
    }
    void check_to_rest(std::size_t last, std::size_t end_gap, std::size_t m) {
        check_ramp("stop", last - m, last, m, speed_beside_rest(end_gap, limits_.decel), limits_.decel);
    }
    void check_ramp(const char* rule, std::size_t from, std::size_t at, std::size_t m, double speed, double rate) {
        if (joints(from, from + m) > 0) { return; }
        const double t = time(from, from + m) + rounding_;
        const double mean = least(std::abs(distance(from, from + m))) / t;
        const double most = speed + rate * (t / 2 + kJointTicks);
        if (mean > most) { object(rule, at, mean, most, m); }
    }

    void object(const char* rule, std::size_t n, double is, double most, std::size_t window) {
        constexpr std::size_t kEnough = 1000;
        if (violations_.size() >= kEnough) { return; }
        char text[160];
        std::snprintf(text, sizeof text, "%.6g steps/tick, at most %.6g, over %zu steps; start velocity %.6g", is, most,
                      window, limits_.start);
        violations_.push_back({rule, axis_, steps_[n].tick.value, first_ + n, text});
    }

    Limits limits_;
    std::span<const StepEdge> steps_;
    const Course& course_;
    const std::vector<Reached>* at_;  // by step; null: homing
    Reached end_;
    std::int64_t least_rest_;
    std::size_t axis_;
    std::size_t first_;
    double rounding_;                         // ticks, in the time between two steps
    double hurry_;                            // factor of a feed, because of the device's own clock
    bool ceases_;                             // the steps may end at any speed
    std::vector<Line> lines_;                 // of each stretch
    std::vector<std::int64_t> counts_{0};     // after each number of steps
    std::vector<std::size_t> joints_before_;  // the earliest place of each step
    std::vector<std::size_t> joints_up_to_;   // the latest place of each step, and the end
    Violations& violations_;
};

}  // namespace

Violations check_limits(const Recording& recording, const Followings& followings) {
    Violations violations;
    const MotorShares map(recording.machine);
    for (std::size_t k = 0; k < recording.jobs.size(); ++k) {
        const Following* following = followings[k] ? &*followings[k] : nullptr;
        for (std::size_t i = 0; i < recording.motors.size(); ++i) {
            const Limits limits = in_ticks(map, recording.machine.tick_ns, i);
            LimitCheck(recording, limits, recording.jobs[k], i, following, violations).check();
        }
    }
    return violations;
}

}  // namespace lockstep::simtest
