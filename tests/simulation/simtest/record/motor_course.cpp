#include "tests/simulation/simtest/record/motor_course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lockstep::simtest {
namespace {

class CourseMap {
public:
    CourseMap(const MotorShares& map, const MachineConfig& machine) : map_(map), machine_(machine) {}

    Course of(Course axes, const Counts& from) const {
        Course course{.from = from, .pauses = axes.pauses, .seconds = axes.seconds * map_.slower()};
        for (std::size_t k = 0; k < axes.stretches.size(); ++k) { course.stretches.push_back(mapped(axes, k)); }
        const Places last(axes.to.begin(), axes.to.end());
        for (std::size_t m = 0; m < map_.motors(); ++m) { course.to.push_back(std::llround(map_.place(m, last))); }
        return course;
    }

private:
    Stretch mapped(const Course& axes, std::size_t k) const {
        Stretch stretch = axes.stretches[k];
        stretch.to.clear();
        stretch.fastest.clear();
        stretch.moved.clear();
        stretch.tolerance = tolerance(axes.stretches[k].tolerance_mm);
        // A joined move that begins or ends at a rest leads to the motor's whole step there, over its whole length.
        constexpr double kRest = 0.5;
        stretch.within = within(stretch) + (stretch.is_joined && !stretch.is_arc ? kRest : 0);
        for (std::size_t m = 0; m < map_.motors(); ++m) {
            const double to = map_.place(m, axes.stretches[k].to);
            stretch.to.push_back(stretch.ends_at_rest ? std::round(to) : to);
            stretch.fastest.push_back(fastest(axes, k, m));
            stretch.moved.push_back(moved(axes, k, m));
        }
        return stretch;
    }

    /// In steps of the motor for which it is greatest; at least 1.
    double tolerance(double mm) const {
        double steps = 1;
        for (std::size_t m = 0; m < map_.motors(); ++m) {
            double of_motor = 0;
            for (std::size_t i = 0; i < machine_.axes.size(); ++i) {
                of_motor += std::abs(map_.share(m, i)) * machine_.axes[i].steps_per_mm * mm;
            }
            steps = std::max(steps, of_motor);
        }
        return steps;
    }

    /// As far as the ends of the stretch, or of its arc, were moved to whole steps: of the axes, and again of the
    /// motor.
    double moved(const Course& axes, std::size_t k, std::size_t m) const {
        const Stretch& stretch = axes.stretches[k];
        const bool begins_at_rest = k == 0 || axes.stretches[k - 1].ends_at_rest;
        double steps = (begins_at_rest ? 0.5 : 0) + (stretch.ends_at_rest || !stretch.moved.empty() ? 0.5 : 0);
        for (std::size_t i = 0; i < stretch.moved.size(); ++i) {
            steps += std::abs(map_.share(m, i)) * stretch.moved[i];
        }
        return steps;
    }

    /// Steps per tick: what the speeds of the axes demand, at most the motor's own limit. On a line all axes have their
    /// parts of the way at the same time.
    double fastest(const Course& axes, std::size_t k, std::size_t m) const {
        const Stretch& stretch = axes.stretches[k];
        const double own = map_.limits(m).top * map_.steps_per_mm(m) * static_cast<double>(machine_.tick_ns) * 1e-9;
        double together = 0;
        double way = 0;
        double most_parts = std::numeric_limits<double>::infinity();  // of the stretch, per tick
        for (std::size_t i = 0; i < stretch.to.size(); ++i) {
            together += std::abs(map_.share(m, i)) * stretch.fastest[i];
            const double steps = stretch.to[i] - axes.at(k, i);
            way += map_.share(m, i) * steps;
            if (steps != 0) { most_parts = std::min(most_parts, stretch.fastest[i] / std::abs(steps)); }
        }
        const bool is_line = !stretch.is_joined && !stretch.is_arc;
        return std::min(own, is_line ? std::abs(way) * most_parts : together);
    }

    const MotorShares& map_;
    const MachineConfig& machine_;
};

}  // namespace

Course course_of_motors(Course axes, const MotorShares& map, const MachineConfig& machine, const Counts& from) {
    if (map.is_direct()) { return axes; }
    return CourseMap(map, machine).of(std::move(axes), from);
}

}  // namespace lockstep::simtest
