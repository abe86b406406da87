#include "clients/lockstep/job/approach.hpp"

#include <algorithm>
#include <cmath>

#include "clients/session/program_start.hpp"

namespace lockstep {
namespace {

using Place = std::vector<double>;

std::expected<std::vector<Lift>, std::string> lifts_named(const MachineConfig& machine, const std::string& option) {
    const auto places = places_named(machine, option);
    if (!places) { return std::unexpected(places.error()); }
    std::vector<Lift> lifts;
    for (const auto& [axis, mm] : *places) { lifts.push_back({axis, mm, true}); }
    return lifts;
}

std::vector<Lift> lifts_to_safe_heights(const MachineConfig& machine) {
    std::vector<Lift> lifts;
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        if (const auto height_mm = machine.axes[i].safe_height_mm) { lifts.push_back({i, *height_mm}); }
    }
    return lifts;
}

/// The axis's position clear of the work, on a whole step. An axis homes away from the work.
double clear_place(const AxisConfig& axis, const Lift& lift, double at_mm, double to_mm) {
    const double place = lockstep::to_mm(axis, static_cast<double>(to_steps(axis, lift.mm)));
    if (lift.is_asked) { return place; }
    return axis.homing.toward_min ? std::min({place, at_mm, to_mm}) : std::max({place, at_mm, to_mm});
}

double distance(const Place& from, const Place& to) {
    double squares = 0;
    for (std::size_t i = 0; i < from.size(); ++i) { squares += (to[i] - from[i]) * (to[i] - from[i]); }
    return std::sqrt(squares);
}

}  // namespace

std::expected<std::vector<Lift>, std::string> lifts_of(const MachineConfig& machine, const std::string& option) {
    if (!option.empty()) { return lifts_named(machine, option); }
    if (auto lifts = lifts_to_safe_heights(machine); !lifts.empty()) { return lifts; }
    int first = machine.axes.front().homing.sequence;
    int last = first;
    for (const AxisConfig& axis : machine.axes) {
        first = std::min(first, axis.homing.sequence);
        last = std::max(last, axis.homing.sequence);
    }
    if (first == last) {
        return std::unexpected(
            "all axes home together and none has a safe_height_mm, so the lifting axis is unknown; name the axis that "
            "leaves "
            "the work first, and a position clear of it: --lift Z=40; or --straight, to go there in one line");
    }
    std::vector<Lift> lifts;
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        const HomingConfig& homing = machine.axes[i].homing;
        if (homing.sequence == first) { lifts.push_back({i, homing.park_mm}); }
    }
    return lifts;
}

std::vector<double> place_before(const Program& program, std::int32_t line) {
    Place place = program.start_mm;
    for (const Block& block : program.blocks) {
        if (block.line >= line) { break; }
        if (const auto* move = std::get_if<ProgramMove>(&block.action)) { place = move->target_mm; }
    }
    return place;
}

double feed_before(const Program& program, std::int32_t line) {
    double feed_mm_s = 0;
    for (const Block& block : program.blocks) {
        if (block.line >= line && feed_mm_s > 0) { break; }
        const auto* move = std::get_if<ProgramMove>(&block.action);
        if (move != nullptr && !move->rapid) { feed_mm_s = move->feed_mm_s; }
    }
    return feed_mm_s;
}

std::vector<ApproachMove> straight_approach(const Place& at_mm, const Place& to_mm) {
    return {{"goes straight", {.target_mm = to_mm, .rapid = true}, distance(at_mm, to_mm)}};
}

std::vector<ApproachMove> approach(const MachineConfig& machine, const std::vector<Lift>& lifts, const Place& at_mm,
                                   const Place& to_mm, double feed_mm_s) {
    std::vector<ApproachMove> moves;
    if (at_mm == to_mm) { return moves; }
    Place lifted = at_mm;
    Place crossed = to_mm;
    double feed = feed_mm_s > 0 ? feed_mm_s : kMaxFeed_mm_s;
    for (const Lift& lift : lifts) {
        const AxisConfig& axis = machine.axes[lift.axis];
        lifted[lift.axis] = clear_place(axis, lift, at_mm[lift.axis], to_mm[lift.axis]);
        crossed[lift.axis] = lifted[lift.axis];
        if (feed_mm_s == 0) { feed = std::min(feed, axis.start_velocity_mm_s); }
    }
    const auto go = [&](const char* what, const Place& from, const Place& to, bool rapid) {
        if (to == from) { return; }
        moves.push_back({what, {.target_mm = to, .feed_mm_s = rapid ? 0 : feed, .rapid = rapid}, distance(from, to)});
    };
    go("lifts", at_mm, lifted, true);
    go("crosses", lifted, crossed, true);
    go("goes down", crossed, to_mm, false);
    return moves;
}

}  // namespace lockstep
