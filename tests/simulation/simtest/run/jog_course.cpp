#include "tests/simulation/simtest/run/jog_course.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::simtest {

namespace {

/// An axis that is jogged, in its steps.
struct Way {
    std::size_t axis = 0;
    double mm_s = 0;
    std::int64_t end = 0;
    std::int64_t least = 1;  // a shorter rest of it is not gone
};

Way way_of(const JogAxis& jog, const MachineConfig& machine, const Counts& from) {
    const AxisConfig& axis = machine.axes[jog.axis];
    const int sign = jog.speed_mm_s > 0 ? 1 : -1;
    const std::int64_t end = nearest_step(axis, sign > 0 ? axis.position_max_mm : axis.position_min_mm);
    const std::int64_t to_end = sign * (end - from[jog.axis]);
    // A distance is one of whole steps, of one at least.
    const std::int64_t asked =
        jog.distance_mm ? std::max<std::int64_t>(1, nearest_step(axis, *jog.distance_mm)) : to_end;
    return {.axis = jog.axis, .mm_s = jog.speed_mm_s, .end = from[jog.axis] + sign * std::min(to_end, asked)};
}

double seconds_of(const Way& way, const MachineConfig& machine, const Counts& here) {
    const std::int64_t left = (way.mm_s > 0 ? 1 : -1) * (way.end - here[way.axis]);
    return left < way.least ? 0 : static_cast<double>(left) / machine.axes[way.axis].steps_per_mm / std::abs(way.mm_s);
}

Counts rest_at(const std::vector<double>& target_mm, const MachineConfig& machine, const Kinematics& kinematics) {
    AxisCounts axes;
    for (std::size_t i = 0; i < target_mm.size(); ++i) { axes.append(nearest_step(machine.axes[i], target_mm[i])); }
    const AxisCounts read = kinematics.axes_at(kinematics.motors_at(axes));
    return {read.begin(), read.end()};
}

}  // namespace

Program program_of_jog(const JogPress& press, const MachineConfig& machine, const Kinematics& kinematics,
                       const Counts& from) {
    Program program{.name = "jog", .axes = {}, .start_mm = {}, .blocks = {}};
    const auto to_mm = [&](std::size_t i, std::int64_t step) {
        return static_cast<double>(step) / machine.axes[i].steps_per_mm;
    };
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        program.axes.push_back(machine.axes[i].name);
        program.start_mm.push_back(to_mm(i, from[i]));
    }
    std::vector<Way> ways;
    for (const JogAxis& jog : press.axes) { ways.push_back(way_of(jog, machine, from)); }
    const auto has_ended = [&](const Counts& here) {
        return [&](const Way& way) { return seconds_of(way, machine, here) <= 0; };
    };
    Counts here = from;
    for (std::erase_if(ways, has_ended(here)); !ways.empty(); std::erase_if(ways, has_ended(here))) {
        const auto duration = [&](const Way& way) { return seconds_of(way, machine, here); };
        const double seconds = duration(*std::ranges::min_element(ways, {}, duration));
        std::vector<double> target_mm;
        for (std::size_t i = 0; i < here.size(); ++i) { target_mm.push_back(to_mm(i, here[i])); }
        double square = 0;
        for (Way& way : ways) {
            target_mm[way.axis] += way.mm_s * seconds;
            square += way.mm_s * way.mm_s;
            way.least = kinematics.rest_steps(AxisIndex{way.axis}) + 1;
        }
        here = rest_at(target_mm, machine, kinematics);
        ProgramMove move{.target_mm = std::move(target_mm), .feed_mm_s = std::sqrt(square), .is_feed_fixed = true};
        move.mode = PathMode::ExactStop;
        program.blocks.push_back({{}, std::move(move)});
    }
    return program;
}

}  // namespace lockstep::simtest
