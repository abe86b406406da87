#include "tests/simulation/simtest/record/course.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::simtest {
namespace {

constexpr double kExactly = 0.5 + 0.04;  // steps: whole pulses, and what pieces of constant acceleration leave
constexpr double kSharp = 0.9;           // cosine: at greater angles of the directions moves are not joined,
constexpr double kLong_mm = 0.1;         // if both are so long

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
          most_feed_(most_feed),
          at_(from.begin(), from.end()),
          course_{.from = from} {}

    Course take() {
        for (const Block& block : program_.blocks) {
            std::visit([this](const auto& a) { add(a); }, block.action);
        }
        come_to_rest();
        for (const double place : at_) { course_.to.push_back(std::llround(place)); }
        for (std::size_t k = 0; k < course_.stretches.size(); ++k) { mark_joined(k); }
        Places from(course_.from.begin(), course_.from.end());
        for (const Stretch& stretch : course_.stretches) {
            course_.seconds += ample_seconds(from, stretch);
            from = stretch.to;
        }
        limit();
        return std::move(course_);
    }

private:
    void add(const LinearMove& move) {
        Stretch stretch{.to = at_};
        for (std::size_t i = 0; i < program_.axes.size(); ++i) {
            for (std::size_t a = 0; a < machine_.axes.size(); ++a) {
                const AxisConfig& axis = machine_.axes[a];
                if (axis.name != program_.axes[i]) { continue; }
                stretch.to[a] = std::clamp(move.target_mm[i] * axis.steps_per_mm,
                                           static_cast<double>(nearest_step(axis, axis.position_min_mm)),
                                           static_cast<double>(nearest_step(axis, axis.position_max_mm)));
            }
        }
        if (stretch.to == at_) { return; }
        feed_.push_back(move.rapid ? 0 : move.feed_mm_s);
        asked_.push_back(stretch.to);
        at_ = stretch.to;
        course_.stretches.push_back(std::move(stretch));
    }
    void add(const Dwell& dwell) {
        come_to_rest();
        course_.stretches.push_back({.to = at_, .seconds = dwell.seconds, .rests = true});
        feed_.push_back(0);
        asked_.push_back(at_);
    }
    void add(const Settle&) { add(Dwell{}); }
    void add(const Pause&) {
        come_to_rest();
        course_.stretches.push_back({.to = at_, .rests = true, .pauses = true});
        feed_.push_back(0);
        asked_.push_back(at_);
        ++course_.pauses;
    }

    /// The machine rests on whole steps.
    void come_to_rest() {
        for (double& place : at_) { place = std::round(place); }
        if (!course_.stretches.empty()) { course_.stretches.back().to = at_; }
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
        stretch.is_joined = !stretch.rests && !(is_sharp(k) && is_sharp(k + 1));
        stretch.within = stretch.is_joined ? 1 : kExactly;
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
        return 2 * seconds;
    }

    /// Speeds of each axis, when all places are known. A joined move begins and ends within half a step of its places.
    void limit() {
        for (std::size_t k = 0; k < course_.stretches.size(); ++k) {
            const Places from = start_of(k);
            Stretch& stretch = course_.stretches[k];
            const double length = length_mm(machine_, from, stretch.to);
            for (std::size_t i = 0; i < from.size(); ++i) {
                const AxisConfig& axis = machine_.axes[i];
                double mm_s = axis.max_velocity_mm_s;
                if (feed_[k] > 0) {
                    const double steps = std::abs(stretch.to[i] - from[i]) + (stretch.is_joined ? 1 : 0);
                    const double share = std::min(1.0, steps / axis.steps_per_mm / length);
                    mm_s = std::min(mm_s, most_feed_ * feed_[k] * share);
                }
                stretch.fastest.push_back(mm_s * axis.steps_per_mm * static_cast<double>(machine_.tick_ns) * 1e-9);
            }
        }
    }

    const Program& program_;
    const MachineConfig& machine_;
    double most_feed_;
    Places at_;
    Course course_;
    std::vector<double> feed_;   // of each stretch; 0: none
    std::vector<Places> asked_;  // where each stretch leads to by the program
};

}  // namespace

std::int64_t nearest_step(const AxisConfig& axis, double mm) {
    return static_cast<std::int64_t>(std::round(mm * axis.steps_per_mm));
}

std::size_t Course::joints(std::size_t axis, double first, double last) const {
    constexpr double kHair = 1e-9;
    std::size_t joints = 0;
    for (auto k = static_cast<std::size_t>(std::max(1.0, std::ceil(first - kHair))); k < stretches.size(); ++k) {
        if (static_cast<double>(k) > last + kHair) { break; }
        const bool moved = at(k, axis) != at(k - 1, axis);
        const bool moves = at(k + 1, axis) != at(k, axis);
        const bool at_pause = stretches[k - 1].pauses || stretches[k].pauses;
        joints += (moved || moves) && !at_pause ? 1 : 0;
    }
    return joints;
}

Course course_of(const Program& program, const MachineConfig& machine, const Counts& from, double most_feed) {
    return CourseMaker(program, machine, from, most_feed).take();
}

}  // namespace lockstep::simtest
