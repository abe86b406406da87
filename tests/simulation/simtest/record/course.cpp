#include "tests/simulation/simtest/record/course.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::simtest {
namespace {

/// A move, a dwell or a pause, in steps of the machine's axes.
struct Stretch {
    Counts to;
    double feed_mm_s = 0;  // 0: none
    double seconds = 0;    // of a dwell
    bool pause = false;
};

std::vector<Stretch> stretches_of(const Program& program, const MachineConfig& machine, Counts at) {
    std::vector<Stretch> stretches;
    for (const Block& block : program.blocks) {
        Stretch stretch{.to = at};
        if (const auto* move = std::get_if<LinearMove>(&block.action)) {
            for (std::size_t i = 0; i < program.axes.size(); ++i) {
                for (std::size_t a = 0; a < machine.axes.size(); ++a) {
                    if (machine.axes[a].name == program.axes[i]) {
                        stretch.to[a] = nearest_step(machine.axes[a], move->target_mm[i]);
                    }
                }
            }
            if (stretch.to == at) { continue; }
            stretch.feed_mm_s = move->rapid ? 0 : move->feed_mm_s;
        } else if (const auto* dwell = std::get_if<Dwell>(&block.action)) {
            stretch.seconds = dwell->seconds;
        } else {
            stretch.pause = true;
        }
        at = stretch.to;
        stretches.push_back(stretch);
    }
    return stretches;
}

double length_mm(const MachineConfig& machine, const Counts& from, const Counts& to) {
    double square = 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const double mm = static_cast<double>(to[i] - from[i]) / machine.axes[i].steps_per_mm;
        square += mm * mm;
    }
    return std::sqrt(square);
}

/// An upper bound for a move from rest to rest. At a corner an axis keeps at least half its start velocity, or the
/// speed that its acceleration allows over this distance; the slowest axis counts.
double ample_seconds(const MachineConfig& machine, const Counts& from, const Stretch& stretch) {
    double seconds = stretch.seconds;
    const double length = length_mm(machine, from, stretch.to);
    if (stretch.feed_mm_s > 0) { seconds += length / stretch.feed_mm_s; }
    for (std::size_t i = 0; i < from.size(); ++i) {
        const AxisConfig& axis = machine.axes[i];
        const double mm = std::abs(static_cast<double>(stretch.to[i] - from[i]) / axis.steps_per_mm);
        const double ramps = axis.max_velocity_mm_s * (1 / axis.max_accel_mm_s2 + 1 / axis.max_decel_mm_s2);
        const double slowest = std::min(axis.max_accel_mm_s2, axis.max_decel_mm_s2);
        const double corners = 4 * mm / axis.start_velocity_mm_s + 4 * std::sqrt(mm / slowest);
        seconds += mm == 0 ? 0 : mm / axis.max_velocity_mm_s + std::min(ramps, corners);
    }
    return 2 * seconds;
}

/// Indexes the moves by step and by gap.
void index_steps(AxisCourse& axis, const std::vector<Stretch>& stretches) {
    const auto steps = static_cast<std::size_t>(axis.steps());
    axis.move_of_step.resize(steps);
    std::vector<std::uint32_t> joints(steps + 1);
    axis.pause_in_gap.assign(steps + 1, false);
    for (std::size_t j = 0; j <= stretches.size(); ++j) {
        const auto gap = static_cast<std::size_t>(axis.travelled[j]);
        const bool moved = j > 0 && axis.direction[j - 1] != 0;
        const bool moves = j < stretches.size() && axis.direction[j] != 0;
        joints[gap] += moved || moves ? 1 : 0;
        if (j == stretches.size()) { break; }
        if (stretches[j].pause) { axis.pause_in_gap[gap] = true; }
        std::fill(axis.move_of_step.begin() + axis.travelled[j], axis.move_of_step.begin() + axis.travelled[j + 1],
                  static_cast<std::uint32_t>(j));
    }
    axis.joints_before.resize(steps + 1);
    std::uint32_t sum = 0;
    for (std::size_t gap = 0; gap <= steps; ++gap) { axis.joints_before[gap] = sum += joints[gap]; }
}

AxisCourse axis_course(const MachineConfig& machine, std::size_t axis, Counts from,
                       const std::vector<Stretch>& stretches, double most_feed) {
    AxisCourse course;
    course.travelled.push_back(0);
    const double per_tick = machine.axes[axis].steps_per_mm * static_cast<double>(machine.tick_ns) * 1e-9;
    for (const Stretch& stretch : stretches) {
        const std::int64_t steps = stretch.to[axis] - from[axis];
        double mm_s = machine.axes[axis].max_velocity_mm_s;
        if (stretch.feed_mm_s > 0) {
            const double mm = std::abs(static_cast<double>(steps)) / machine.axes[axis].steps_per_mm;
            mm_s = std::min(mm_s, most_feed * stretch.feed_mm_s * mm / length_mm(machine, from, stretch.to));
        }
        course.travelled.push_back(course.travelled.back() + std::abs(steps));
        course.direction.push_back(static_cast<std::int8_t>(steps == 0 ? 0 : (steps > 0 ? 1 : -1)));
        course.fastest.push_back(mm_s * per_tick);
        from = stretch.to;
    }
    index_steps(course, stretches);
    return course;
}

}  // namespace

std::int64_t nearest_step(const AxisConfig& axis, double mm) {
    return static_cast<std::int64_t>(std::round(mm * axis.steps_per_mm));
}

Course course_of(const Program& program, const MachineConfig& machine, const Counts& from, double most_feed) {
    const std::vector<Stretch> stretches = stretches_of(program, machine, from);
    Course course{.from = from, .to = stretches.empty() ? from : stretches.back().to};
    course.moves = stretches.size();
    for (std::size_t i = 0; i < from.size(); ++i) {
        course.axes.push_back(axis_course(machine, i, from, stretches, most_feed));
    }
    Counts at = from;
    for (const Stretch& stretch : stretches) {
        course.pauses += stretch.pause ? 1 : 0;
        course.seconds += ample_seconds(machine, at, stretch);
        at = stretch.to;
    }
    return course;
}

}  // namespace lockstep::simtest
