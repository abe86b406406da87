#include "tests/simulation/simtest/record/course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace lockstep::simtest {
namespace {

constexpr double kSharp = 0.9;         // cosine: moves with a greater angle between their directions are not joined,
constexpr double kLong_mm = 0.1;       // if both are longer than this
constexpr double kPoint_steps = 0.25;  // the machine goes straight to the end of an arc whose radii are at most this
constexpr double kJointHair = 1e-9;    // part of a stretch: a place this near to a joint is at the joint

double length_mm(const MachineConfig& machine, const Places& from, const Places& to) {
    double square = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const double mm = (to[i] - from[i]) / machine.axes[i].steps_per_mm;
        square += mm * mm;
    }
    return std::sqrt(square);
}

class CourseMaker {
public:
    CourseMaker(const Program& program, const MachineConfig& machine, const Counts& from, double most_feed)
        : program_(program),
          machine_(machine),
          motors_(machine),
          most_feed_(most_feed),
          at_(from.begin(), from.end()),
          programmed_mm_(program.start_mm),
          course_{.from = from} {}

    Course take() {
        for (const Block& block : program_.blocks) {
            std::visit([this](const auto& a) { add(a); }, block.action);
        }
        come_to_rest();
        course_.last_events = std::move(events_);
        for (const double place : at_) { course_.to.push_back(std::llround(place)); }
        for (std::size_t k = 0; k < course_.stretches.size(); ++k) { mark_joined(k); }
        Places from(course_.from.begin(), course_.from.end());
        for (const Stretch& stretch : course_.stretches) {
            course_.seconds += ample_seconds(from, stretch);
            from = stretch.to;
        }
        limit();
        for (std::size_t k = 0; k < course_.stretches.size(); ++k) { time_at_feed(k); }
        return std::move(course_);
    }

private:
    void add(const ProgramMove& move) {
        move.arc&& arc_steps(move) > kPoint_steps ? add_arc(move) : add_line(move);
        programmed_mm_ = move.target_mm;
        if (move.mode == PathMode::ExactStop) { add(Dwell{}); }  // the machine rests
    }
    /// Its greater radius, in steps of the finer axis.
    double arc_steps(const ProgramMove& move) const {
        const std::size_t first = move.arc->first;
        const std::size_t second = move.arc->second;
        const auto radius = [&](const std::vector<double>& at) {
            return std::hypot(at[first] - move.arc->centre_first_mm, at[second] - move.arc->centre_second_mm);
        };
        return std::max(scale_of(first), scale_of(second)) * std::max(radius(programmed_mm_), radius(move.target_mm));
    }
    /// Adds an arc as chords that deviate from it by at most a fiftieth of a step.
    void add_arc(const ProgramMove& move) {
        const std::size_t first = move.arc->first;
        const std::size_t second = move.arc->second;
        const std::vector<double> from = programmed_mm_;
        const std::vector<double> off = off_mm();
        const double x = from[first] - move.arc->centre_first_mm;
        const double y = from[second] - move.arc->centre_second_mm;
        const double to_x = move.target_mm[first] - move.arc->centre_first_mm;
        const double to_y = move.target_mm[second] - move.arc->centre_second_mm;
        const double sense = move.arc->is_clockwise ? -1 : 1;
        double sweep = std::remainder(sense * (std::atan2(to_y, to_x) - std::atan2(y, x)), 2 * std::numbers::pi);
        if (sweep < 1e-9) { sweep += 2 * std::numbers::pi; }
        sweep += 2 * std::numbers::pi * (move.arc->turns - 1);
        const double radius = std::hypot(x, y);
        const double chords = std::ceil(sweep / std::sqrt(8 * 0.02 / std::max(arc_steps(move), 1.0)));
        arc_ = course_.stretches.size();
        for (double k = 1; k < chords; ++k) {
            ProgramMove chord = move;
            const double share = k / chords;
            for (std::size_t i = 0; i < from.size(); ++i) {
                chord.target_mm[i] = from[i] + share * (move.target_mm[i] - from[i]);
            }
            const double r = radius + share * (std::hypot(to_x, to_y) - radius);
            const double angle = std::atan2(y, x) + sense * share * sweep;
            chord.target_mm[first] = move.arc->centre_first_mm + r * std::cos(angle);
            chord.target_mm[second] = move.arc->centre_second_mm + r * std::sin(angle);
            for (std::size_t i = 0; i < from.size(); ++i) { chord.target_mm[i] += off[i] * (1 - share); }
            add_chord(chord);
        }
        add_chord(move);
    }
    void add_chord(const ProgramMove& chord) {
        const std::size_t before = course_.stretches.size();
        add_line(chord);
        if (course_.stretches.size() > before) { course_.stretches.back().is_arc = true; }
    }

    /// Steps of its finest motor, per mm.
    double scale_of(std::size_t axis) const {
        const auto found = std::ranges::find(machine_.axes, program_.axes[axis], &AxisConfig::name);
        return found->steps_per_mm * motors_.finest(static_cast<std::size_t>(found - machine_.axes.begin()));
    }
    /// How far the program's axes are from the programmed place: less than a step, because they rest on whole steps.
    std::vector<double> off_mm() const {
        std::vector<double> mm;
        for (std::size_t i = 0; i < program_.axes.size(); ++i) {
            const auto axis = std::ranges::find(machine_.axes, program_.axes[i], &AxisConfig::name);
            const double at = at_[static_cast<std::size_t>(axis - machine_.axes.begin())] / axis->steps_per_mm;
            mm.push_back(at - programmed_mm_[i]);
        }
        return mm;
    }

    void add_line(const ProgramMove& move) {
        Stretch stretch{.to = at_};
        for (std::size_t i = 0; i < program_.axes.size(); ++i) {
            for (const AxisIndex a : axis_indices(machine_.axes.size())) {
                const AxisConfig& axis = machine_.axes[a];
                if (axis.name == program_.axes[i]) { stretch.to[a] = move.target_mm[i] * axis.steps_per_mm; }
            }
        }
        // An axis that rests beyond its travel, because its motors rest on whole steps, returns with the next move.
        for (const AxisIndex a : axis_indices(machine_.axes.size())) {
            const AxisConfig& axis = machine_.axes[a];
            stretch.to[a] = std::clamp(stretch.to[a], static_cast<double>(nearest_step(axis, axis.position_min_mm)),
                                       static_cast<double>(nearest_step(axis, axis.position_max_mm)));
        }
        if (stretch.to == at_) { return; }
        feed_.push_back(move.rapid ? 0 : move.feed_mm_s);
        asked_.push_back(stretch.to);
        stretch.is_exact = move.mode != PathMode::Blend;
        stretch.tolerance = tolerance_of(move);
        stretch.tolerance_mm = move.tolerance_mm;
        at_ = stretch.to;
        add_stretch(std::move(stretch));
    }
    void add_stretch(Stretch stretch) {
        stretch.events = std::exchange(events_, {});
        course_.stretches.push_back(std::move(stretch));
    }
    /// In steps, of the axis for which it is greatest; at least 1.
    double tolerance_of(const ProgramMove& move) const {
        double steps = 1;
        for (const AxisConfig& axis : machine_.axes) { steps = std::max(steps, move.tolerance_mm * axis.steps_per_mm); }
        return steps;
    }
    void add(const Dwell& dwell) {
        come_to_rest();
        add_stretch({.to = at_, .seconds = dwell.seconds, .rests = true, .ends_at_rest = true});
        feed_.push_back(0);
        asked_.push_back(at_);
    }
    void add(const ProgramEvent& event) { events_.push_back(event); }
    void add(const Settle&) { add(Dwell{}); }
    void add(const Probe&) { add(Dwell{}); }
    void add(const Pause&) {
        come_to_rest();
        add_stretch({.to = at_, .rests = true, .pauses = true, .ends_at_rest = true});
        feed_.push_back(0);
        asked_.push_back(at_);
        ++course_.pauses;
    }

    /// The machine rests on whole steps.
    void come_to_rest() {
        Places moved;
        for (double& place : at_) {
            moved.push_back(std::abs(std::round(place) - place));
            place = std::round(place);
        }
        if (course_.stretches.empty()) { return; }
        course_.stretches.back().to = at_;
        course_.stretches.back().ends_at_rest = true;
        if (!course_.stretches.back().is_arc) { return; }
        for (std::size_t k = arc_; k < course_.stretches.size(); ++k) { course_.stretches[k].moved = moved; }
    }

    Places start_of(std::size_t k) const {
        return k == 0 ? Places(course_.from.begin(), course_.from.end()) : course_.stretches[k - 1].to;
    }

    bool is_sharp(std::size_t k) const {
        if (k == 0 || k == course_.stretches.size()) { return true; }
        if (course_.stretches[k - 1].rests || course_.stretches[k].rests) { return true; }
        const Places a = start_of(k - 1);
        const Places& b = asked_[k - 1];  // before rests were moved to whole steps
        const Places& c = asked_[k];
        const double before = length_mm(machine_, a, b);
        const double behind = length_mm(machine_, b, c);
        double product = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double scale = machine_.axes[i].steps_per_mm;
            product += (b[i] - a[i]) * (c[i] - b[i]) / scale / scale;
        }
        return before > kLong_mm && behind > kLong_mm && product < kSharp * before * behind;
    }
    void mark_joined(std::size_t k) {
        Stretch& stretch = course_.stretches[k];
        stretch.is_joined = !stretch.rests && !stretch.is_exact && !(is_sharp(k) && is_sharp(k + 1));
        stretch.within = within(stretch);
    }

    /// An upper bound for a move from rest to rest. At a corner an axis keeps at least half its start velocity, or the
    /// speed that its acceleration allows over this distance; the slowest axis counts.
    double ample_seconds(const Places& from, const Stretch& stretch) {
        const double feed = feed_[static_cast<std::size_t>(&stretch - course_.stretches.data())];
        double seconds = stretch.seconds;
        const double length = length_mm(machine_, from, stretch.to);
        if (feed > 0) { seconds += length / feed; }
        for (std::size_t i = 0; i < from.size(); ++i) {
            const AxisConfig& axis = machine_.axes[i];
            const double mm = std::abs((stretch.to[i] - from[i]) / axis.steps_per_mm);
            const double ramps = axis.max_velocity_mm_s * (1 / axis.max_accel_mm_s2 + 1 / axis.max_decel_mm_s2);
            const double slowest = std::min(axis.max_accel_mm_s2, axis.max_decel_mm_s2);
            const double corners = 4 * mm / axis.start_velocity_mm_s + 4 * std::sqrt(mm / slowest);
            seconds += mm == 0 ? 0 : mm / axis.max_velocity_mm_s + std::min(ramps, corners);
        }
        return 2 * (seconds + seconds_for_outputs(stretch, length));
    }
    /// A path is slowed where its events would not fit into frames and tails.
    double seconds_for_outputs(const Stretch& stretch, double length) const {
        if (machine_.outputs.empty() || stretch.events.empty()) { return 0; }
        double slowest = std::numeric_limits<double>::infinity();
        for (const AxisConfig& axis : machine_.axes) { slowest = std::min(slowest, axis.max_decel_mm_s2); }
        const double frame_s = static_cast<double>(machine_.frame_ticks().value) / machine_.ticks_per_second();
        return static_cast<double>(stretch.events.size()) * (frame_s / 10 + std::sqrt(length / slowest));
    }

    /// Sets the speeds of each axis, after all places are known. A joined move may begin and end half a step of a motor
    /// off.
    void limit() {
        for (std::size_t k = 0; k < course_.stretches.size(); ++k) {
            const Places from = start_of(k);
            Stretch& stretch = course_.stretches[k];
            const double length = length_mm(machine_, from, stretch.to);
            for (std::size_t i = 0; i < from.size(); ++i) {
                const AxisConfig& axis = machine_.axes[i];
                double mm_s = axis.max_velocity_mm_s;
                if (feed_[k] > 0) {
                    const double off = stretch.is_joined ? motors_.step_of(i) : 0;
                    const double steps = std::abs(stretch.to[i] - from[i]) + off;
                    const double share = stretch.is_arc ? 1 : std::min(1.0, steps / axis.steps_per_mm / length);
                    mm_s = std::min(mm_s, most_feed_ * feed_[k] * share);
                }
                stretch.fastest.push_back(mm_s * axis.steps_per_mm * static_cast<double>(machine_.tick_ns) * 1e-9);
            }
        }
    }

    /// A joined move may be shorter by its tolerance at both ends, and have there the feed of the moves beside it.
    void time_at_feed(std::size_t k) {
        if (feed_[k] == 0) { return; }
        const double ticks_per_mm = machine_.ticks_per_second() / feed_[k];
        Stretch& stretch = course_.stretches[k];
        stretch.feed_ticks = length_mm(machine_, start_of(k), stretch.to) * ticks_per_mm;
        double step_mm = 0;
        for (const AxisIndex i : axis_indices(machine_.axes.size())) {
            step_mm = std::max(step_mm, motors_.step_of(i) / machine_.axes[i].steps_per_mm);
        }
        const double tolerance_mm = stretch.is_joined ? std::max(stretch.tolerance_mm, step_mm) : 0;
        double slowest = feed_[k];
        for (const std::size_t j : {k - 1, k + 1}) {
            if (stretch.is_joined && j < feed_.size() && feed_[j] > 0) { slowest = std::min(slowest, feed_[j]); }
        }
        stretch.feed_slack_ticks = 2 * (tolerance_mm + step_mm) * machine_.ticks_per_second() / slowest;
    }

    const Program& program_;
    const MachineConfig& machine_;
    MotorShares motors_;
    double most_feed_;
    Places at_;
    std::vector<double> programmed_mm_;  // the end of the last move, for the program's axes
    Course course_;
    std::vector<ProgramEvent> events_;  // since the last stretch
    std::size_t arc_ = 0;               // the first chord of the last arc
    std::vector<double> feed_;          // of each stretch; 0: none
    std::vector<Places> asked_;         // the programmed end of each stretch
};

}  // namespace

double within(const Stretch& stretch) {
    constexpr double kExactly = 0.5 + 0.04;  // rounding to pulses, and what pieces of constant acceleration deviate
    constexpr double kArc = 1.04;  // the same, and up to half a step: an arc before a rest ends on whole steps
    return stretch.is_arc ? kArc : stretch.is_joined ? stretch.tolerance : kExactly;
}

std::size_t Course::last_part(std::size_t stretch) const {
    while (stretch + 1 < stretches.size() && stretches[stretch + 1].continues) { ++stretch; }
    return stretch;
}

Joints::Joints(const Course& course, std::size_t axis) : before_{0, 0} {
    for (std::size_t k = 1; k < course.stretches.size(); ++k) {
        const Stretch& before = course.stretches[k - 1];
        const Stretch& behind = course.stretches[k];
        const bool moved = course.at(k, axis) != course.at(k - 1, axis);
        const bool moves = course.at(k + 1, axis) != course.at(k, axis);
        const bool is_moved = moved || moves || before.is_joined || behind.is_joined;
        const bool is_none = before.pauses || behind.pauses || behind.continues;
        before_.push_back(before_.back() + (is_moved && !is_none ? 1 : 0));
    }
}

std::size_t Joints::before(double place) const {
    const auto k = static_cast<std::size_t>(std::max(0.0, std::ceil(place - kJointHair)));
    return before_[std::min(k, before_.size() - 1)];
}

std::size_t Joints::up_to(double place) const {
    const auto k = static_cast<std::size_t>(std::max(0.0, place + kJointHair));
    return before_[std::min(k + 1, before_.size() - 1)];
}

Course course_of(const Program& program, const MachineConfig& machine, const Counts& from, double most_feed) {
    return CourseMaker(program, machine, from, most_feed).take();
}

}  // namespace lockstep::simtest
