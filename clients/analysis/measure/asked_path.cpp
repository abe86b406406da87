#include "clients/analysis/measure/asked_path.hpp"

#include <cmath>
#include <cstdlib>
#include <span>

#include "clients/planning/plan_summary.hpp"

namespace lockstep::analysis {
namespace {

using Parts = std::span<const PathMove>;  // of one block of the program

/// The parts of the first block.
Parts first_block(Parts rest) {
    std::size_t count = 1;
    while (count < rest.size() && rest[count].block == rest[0].block) { ++count; }
    return rest.first(count);
}

std::int64_t steps_of(Parts parts, std::size_t axis) {
    return std::abs(parts.back().to[axis] - parts.front().from[axis]);
}

std::size_t lead_of(Parts parts) {
    std::size_t lead = 0;
    for (std::size_t axis = 1; axis < parts.front().from.size(); ++axis) {
        if (steps_of(parts, axis) > steps_of(parts, lead)) { lead = axis; }
    }
    return lead;
}

/// When the lead axis of one part is `steps` from the part's beginning, after the path's start: by bisection.
Subticks when(const PathMove& part, double steps) {
    Subticks low;
    Subticks high = part.profile.duration();
    while (low < high) {
        const Subticks middle{low.value + (high.value - low.value) / 2};
        if (part.profile.at(middle).as_steps() < steps) {
            low = {middle.value + 1};
        } else {
            high = middle;
        }
    }
    return part.start + low;
}

/// Steps fall at half-steps: the first half a step after the beginning, the last half a step before the end.
Ticks stepping_time(Parts parts, std::size_t axis) {
    const auto makes_steps = [&](const PathMove& part) { return part.to[axis] != part.from[axis]; };
    while (!parts.empty() && !makes_steps(parts.front())) { parts = parts.subspan(1); }
    while (!parts.empty() && !makes_steps(parts.back())) { parts = parts.first(parts.size() - 1); }
    if (parts.empty()) { return {}; }
    const double first = 0.5 / std::abs(parts.front().share(axis));
    const double last = static_cast<double>(parts.back().lead) - 0.5 / std::abs(parts.back().share(axis));
    return (when(parts.back(), last) - when(parts.front(), first)).floor();
}

AskedMove move_of(Parts parts) {
    AskedMove move{.line = parts.front().line,
                   .planned = (parts.back().end() - parts.front().start).ceil(),
                   .lead = lead_of(parts)};
    for (const PathMove& part : parts) { move.length_mm += part.length_mm; }
    move.stepping = stepping_time(parts, move.lead);
    return move;
}

}  // namespace

std::int64_t AskedPath::steps(std::size_t move, std::size_t axis) const {
    return std::abs(to(move, axis) - from(move, axis));
}

std::expected<AskedPath, std::string> AskedPath::of(const MachineConfig& machine, const Program& program) {
    const auto plan = plan_program(machine, program);
    if (!plan) { return std::unexpected(plan.error().text); }
    AskedPath asked;
    asked.planned_ = plan->duration;
    asked.legs_ = static_cast<std::int64_t>(plan->paths.size());
    asked.moves_of_.resize(machine.axes.size());
    for (const AxisConfig& axis : machine.axes) { asked.mm_per_step_.push_back(1 / axis.steps_per_mm); }
    const auto add_place = [&asked](const AxisCounts& counts) {
        asked.counts_.insert(asked.counts_.end(), counts.begin(), counts.end());
    };
    for (const Path& path : plan->paths) {
        if (asked.counts_.empty()) { add_place(path.moves.front().from); }
        for (Parts rest = path.moves; !rest.empty();) {
            const Parts parts = first_block(rest);
            rest = rest.subspan(parts.size());
            const auto number = static_cast<std::uint32_t>(asked.moves_.size());
            asked.moves_.push_back(move_of(parts));
            add_place(parts.back().to);
            for (std::size_t axis = 0; axis < asked.axes(); ++axis) {
                if (asked.steps(number, axis) != 0) { asked.moves_of_[axis].push_back(number); }
            }
        }
    }
    return asked;
}

}  // namespace lockstep::analysis
