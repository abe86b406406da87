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
        Course course{.from = from,
                      .last_events = axes.last_events,
                      .pauses = axes.pauses,
                      .seconds = axes.seconds * map_.slower()};
        for (std::size_t k = 0; k < axes.stretches.size(); ++k) { add_parts(axes, k, course.stretches); }
        const Places last(axes.to.begin(), axes.to.end());
        for (std::size_t m = 0; m < map_.motors(); ++m) { course.to.push_back(std::llround(map_.place(m, last))); }
        return course;
    }

private:
    /// A stretch of the axes from one place to another, or a part of it.
    struct Part {
        Places begin;
        Places end;
        double from = 0;  // of the stretch
        double to = 1;
    };

    static Places start_of(const Course& axes, std::size_t k) {
        return k == 0 ? Places(axes.from.begin(), axes.from.end()) : axes.stretches[k - 1].to;
    }
    static Places between(const Places& a, const Places& b, double share) {
        Places place = a;
        for (std::size_t i = 0; i < a.size(); ++i) { place[i] += share * (b[i] - a[i]); }
        return share == 1 ? b : place;
    }

    /// One part, or so many that the way of each motor is nearly a line in each of them.
    void add_parts(const Course& axes, std::size_t k, std::vector<Stretch>& parts) const {
        constexpr double kNearly_steps = 0.01;
        const Places from = start_of(axes, k);
        const Places& to = axes.stretches[k].to;
        double bulge = 0;
        for (std::size_t m = 0; m < map_.motors(); ++m) { bulge = std::max(bulge, map_.bulge(m, from, to)); }
        const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(std::sqrt(bulge / kNearly_steps))));
        const auto all = static_cast<double>(count);
        for (std::size_t n = 0; n < count; ++n) {
            Part part{.begin = {}, .end = {}, .from = static_cast<double>(n) / all};
            part.to = static_cast<double>(n + 1) / all;
            part.begin = between(from, to, part.from);
            part.end = between(from, to, part.to);
            parts.push_back(mapped(axes, k, part));
            parts.back().continues = n > 0;
            parts.back().ends_at_rest = axes.stretches[k].ends_at_rest && n + 1 == count;
        }
    }

    Stretch mapped(const Course& axes, std::size_t k, const Part& part) const {
        Stretch stretch = axes.stretches[k];
        stretch.to.clear();
        stretch.fastest.clear();
        stretch.moved.clear();
        if (part.from > 0) { stretch.events.clear(); }
        stretch.feed_ticks *= part.to - part.from;
        stretch.tolerance = tolerance(axes.stretches[k].tolerance_mm);
        // A joined move that begins or ends at a rest leads to the motor's whole step there, over its whole length.
        constexpr double kRest = 0.5;
        constexpr double kCurve = 0.04;  // what the pieces of a curve deviate, here and in a path
        stretch.within = within(stretch) + (stretch.is_joined && !stretch.is_arc ? kRest : 0);
        if (map_.any_is_curved()) { stretch.within += kCurve; }
        for (std::size_t m = 0; m < map_.motors(); ++m) {
            const double to = map_.place(m, part.end) + rest_offset(axes, k, m, part.to);
            stretch.to.push_back(stretch.ends_at_rest && part.to == 1 ? std::round(to) : to);
            stretch.fastest.push_back(fastest(axes, k, m, part));
            stretch.moved.push_back(moved(axes, k, m));
        }
        return stretch;
    }

    /// A line leads each motor from its whole step at a rest to the one at the next, over its whole length. If no motor
    /// is curved, the line is one stretch from end to end.
    double rest_offset(const Course& axes, std::size_t k, std::size_t m, double share) const {
        if (!map_.any_is_curved()) { return 0; }
        const auto to_whole = [&](const Places& place) {
            return std::round(map_.place(m, place)) - map_.place(m, place);
        };
        const bool begins_at_rest = k == 0 || axes.stretches[k - 1].ends_at_rest;
        const double begin = begins_at_rest ? to_whole(start_of(axes, k)) : 0;
        const double end = axes.stretches[k].ends_at_rest ? to_whole(axes.stretches[k].to) : 0;
        return begin + (end - begin) * share;
    }

    /// In steps of the motor for which it is greatest; at least 1.
    double tolerance(double mm) const {
        double steps = 1;
        for (std::size_t m = 0; m < map_.motors(); ++m) {
            double of_motor = 0;
            for (const AxisIndex i : axis_indices(machine_.axes.size())) {
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

    /// Steps per tick: what the speeds of the axes demand, at most the motor's own limit. A motor that is curved is
    /// fastest at one of the ends.
    double fastest(const Course& axes, std::size_t k, std::size_t m, const Part& part) const {
        const double own = map_.limits(m).top * map_.steps_per_mm(m) * static_cast<double>(machine_.tick_ns) * 1e-9;
        return std::min(own, std::max(demanded(axes, k, m, part.begin), demanded(axes, k, m, part.end)));
    }

    /// On a line all axes have their parts of the way at the same time.
    double demanded(const Course& axes, std::size_t k, std::size_t m, const Places& at) const {
        const Stretch& stretch = axes.stretches[k];
        double together = 0;
        double way = rest_offset(axes, k, m, 1) - rest_offset(axes, k, m, 0);
        double most_parts = std::numeric_limits<double>::infinity();  // of the stretch, per tick
        for (std::size_t i = 0; i < stretch.to.size(); ++i) {
            const double share = map_.share_at(m, i, at);
            together += std::abs(share) * stretch.fastest[i];
            const double steps = stretch.to[i] - axes.at(k, i);
            way += share * steps;
            if (steps != 0) { most_parts = std::min(most_parts, stretch.fastest[i] / std::abs(steps)); }
        }
        const bool is_line = !stretch.is_joined && !stretch.is_arc;
        return is_line ? std::abs(way) * most_parts : together;
    }

    const MotorShares& map_;
    const MachineConfig& machine_;
};

/// Boards rest at 0. Their places are behind those of the axes.
Course with_boards(Course axes, std::size_t motors) {
    axes.from.resize(motors);
    axes.to.resize(motors);
    for (Stretch& stretch : axes.stretches) {
        stretch.to.resize(motors);
        stretch.fastest.resize(motors);
        if (!stretch.moved.empty()) { stretch.moved.resize(motors); }
    }
    return axes;
}

/// How often a slide turns on the course, at most.
std::size_t turns_of(const Course& course, std::size_t motor) {
    std::size_t turns = 1;
    double last = 0;
    for (std::size_t k = 0; k < course.stretches.size(); ++k) {
        const double way = course.at(k + 1, motor) - course.at(k, motor);
        if (way * last < 0) { ++turns; }
        if (way != 0) { last = way; }
    }
    return turns;
}

/// The path waits where motors take up their backlash. A slide that goes back by a fifth of a step may not follow yet.
void add_backlash(const MotorShares& map, Course& course) {
    constexpr double kSlack_steps = 0.2;
    if (!map.any_has_play()) { return; }
    for (Stretch& stretch : course.stretches) { stretch.within += kSlack_steps; }
    for (std::size_t m = 0; m < map.motors(); ++m) {
        const double once_s = static_cast<double>(map.play(m)) / map.steps_per_mm(m) / map.limits(m).start;
        course.seconds += 2 * once_s * static_cast<double>(turns_of(course, m));
    }
}

}  // namespace

Course course_of_motors(Course axes, const MotorShares& map, const MachineConfig& machine, const Counts& from) {
    Course course = map.is_direct() ? with_boards(std::move(axes), map.motors())
                                    : CourseMap(map, machine).of(std::move(axes), from);
    add_backlash(map, course);
    return course;
}

}  // namespace lockstep::simtest
