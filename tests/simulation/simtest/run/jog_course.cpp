#include "tests/simulation/simtest/run/jog_course.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep::simtest {

Program program_of_jog(const JogPress& press, const MachineConfig& machine, const Counts& from) {
    struct Way {
        std::size_t place = 0;  // in the program
        double mm_s = 0;
        double seconds = 0;  // left
    };
    Program program{.name = "jog", .axes = {}, .start_mm = {}, .blocks = {}};
    std::vector<Way> ways;
    for (const JogAxis& jog : press.axes) {
        const AxisConfig& axis = machine.axes[jog.axis];
        const double at = static_cast<double>(from[jog.axis]) / axis.steps_per_mm;
        const bool is_forward = jog.speed_mm_s > 0;
        const std::int64_t end = nearest_step(axis, is_forward ? axis.position_max_mm : axis.position_min_mm);
        const std::int64_t to_end = is_forward ? end - from[jog.axis] : from[jog.axis] - end;
        // A distance is one of whole steps, of one at least.
        const std::int64_t asked =
            jog.distance_mm ? std::max<std::int64_t>(1, nearest_step(axis, *jog.distance_mm)) : to_end;
        const double mm = static_cast<double>(std::min(to_end, asked)) / axis.steps_per_mm;
        if (mm > 0) { ways.push_back({program.axes.size(), jog.speed_mm_s, mm / std::abs(jog.speed_mm_s)}); }
        program.axes.push_back(axis.name);
        program.start_mm.push_back(at);
    }
    std::vector<double> at = program.start_mm;
    while (!ways.empty()) {
        const double seconds = std::ranges::min_element(ways, {}, &Way::seconds)->seconds;
        double square = 0;
        for (Way& way : ways) {
            at[way.place] += way.mm_s * seconds;
            way.seconds -= seconds;
            square += way.mm_s * way.mm_s;
        }
        ProgramMove move{.target_mm = at, .feed_mm_s = std::sqrt(square), .is_feed_fixed = true};
        move.mode = PathMode::ExactStop;
        program.blocks.push_back({{}, std::move(move)});
        std::erase_if(ways, [](const Way& way) { return way.seconds <= 0; });
    }
    return program;
}

}  // namespace lockstep::simtest
