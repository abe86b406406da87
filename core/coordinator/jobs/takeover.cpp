#include "core/coordinator/jobs/takeover.hpp"

#include <algorithm>
#include <array>
#include <optional>

namespace lockstep {
namespace {

using Doubt = std::unexpected<TakeoverDoubt>;

/// What solving pieces in whole units leaves between an axis and its exact share of the path: far less than this.
constexpr Displacement kRounding{Int128{1} << 44};

bool is_in_doubt(const AxisView& axis) {
    return !axis.state || !axis.state->homed || axis.state->fault != 0 || !axis.state->at_rest;
}

/// The last frame that all axes ran; 0: none of the epoch.
std::expected<FrameNumber, TakeoverDoubt> last_frame(const MachineState& last, std::span<const AxisView> axes) {
    std::optional<FrameNumber> ran;
    for (const AxisView& axis : axes) {
        if (is_in_doubt(axis)) { return Doubt(TakeoverDoubt::AxisInDoubt); }
        if (axis.state->epoch > last.epoch) { return Doubt(TakeoverDoubt::UnreceivedFrames); }
        const FrameNumber its = axis.state->epoch == last.epoch ? axis.state->ran : 0;
        if (ran && *ran != its) { return Doubt(TakeoverDoubt::FramesDiffer); }
        ran = its;
    }
    return ran.value_or(0);
}

/// Axes that the program does not name stand where they always did.
AxisCounts start_of_job(const Program& program, const MachineConfig& machine, std::span<const AxisView> axes) {
    AxisCounts start;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const auto named = std::ranges::find(program.axes, machine.axes[i].name);
        const auto place = static_cast<std::size_t>(named - program.axes.begin());
        const bool is_named = named != program.axes.end() && place < program.start_mm.size();
        start.append(is_named ? to_steps(machine.axes[i], program.start_mm[place]) : axes[i].state->position.count());
    }
    return start;
}

/// Finds the place in the legs: which of them, and what is left of it. A move that is done is left out.
std::expected<JobRest, TakeoverDoubt> locate(std::vector<Leg> legs, const FrameRest& rest) {
    const auto is_block = [&](const PathMove& move) { return move.block == rest.place.block; };
    for (std::size_t leg = 0; leg < legs.size(); ++leg) {
        const std::vector<PathMove>& moves = legs[leg].moves;
        const auto at = std::ranges::find_if(moves, is_block);
        if (at == moves.end()) { continue; }
        const Displacement whole = Displacement::steps(at->lead);
        if (rest.place.along < Displacement{} || rest.place.along > whole) { break; }
        const bool is_done = rest.last || (at->lead != 0 && rest.place.along == whole);
        JobRest found{.leg = leg, .place = rest.place, .remaining = {at + (is_done ? 1 : 0), moves.end()}};
        if (rest.last && !found.remaining.empty()) { break; }
        found.leg_done = found.remaining.empty();
        if (is_done && !found.leg_done) { found.place = {found.remaining.front().block, {}}; }
        found.legs = std::move(legs);
        return found;
    }
    return Doubt(TakeoverDoubt::OtherPlan);
}

/// Where each axis is to be by the program.
std::vector<Position> planned_positions(const JobRest& rest) {
    const bool ahead = !rest.leg_done;
    const PathMove& move = ahead ? rest.remaining.front() : rest.legs[rest.leg].moves.back();
    std::vector<Position> positions;
    for (std::size_t i = 0; i < move.from.size(); ++i) {
        positions.push_back(ahead ? move.axis_at(i, rest.place.along) : Position::steps(move.to[i]));
    }
    return positions;
}

bool is_near(Position a, Position b) { return a - b < kRounding && b - a < kRounding; }

}  // namespace

std::string_view text_of(TakeoverDoubt doubt) {
    constexpr std::array<std::string_view, 9> kTexts{
        "takeovers stop jobs here; --on-takeover continue goes on with them",
        "it was not running freely: it was held, paused, being stopped, or is not a program",
        "a hold or stop was asked for meanwhile",
        "its program has not arrived here",
        "what its owner said of it does not fit its program",
        "an axis is missing, was restarted, is not homed or has a fault",
        "the axes did not all run the same frames",
        "the axes ran frames that were not received from its owner",
        "an axis is not where its frames end"};
    return kTexts[static_cast<std::size_t>(doubt)];
}

std::expected<JobRest, TakeoverDoubt> rest_of_job(const MachineState& last, const Program& program,
                                                  const MachineConfig& machine, std::span<const AxisView> axes) {
    const auto ran = last_frame(last, axes);
    if (!ran) { return Doubt(ran.error()); }
    const auto said = std::ranges::find(last.rests, *ran, &FrameRest::frame);
    if (said == last.rests.end()) { return Doubt(TakeoverDoubt::UnreceivedFrames); }
    auto legs = ProgramPlanner(machine).plan(program, start_of_job(program, machine, axes));
    if (!legs) { return Doubt(TakeoverDoubt::OtherPlan); }
    auto rest = locate(std::move(*legs), *said);
    if (!rest) { return rest; }

    std::vector<Position> positions;
    for (const AxisView& axis : axes) { positions.push_back(axis.state->position); }
    const std::vector<Position> planned = planned_positions(*rest);
    if (!std::ranges::equal(positions, planned, is_near)) { return Doubt(TakeoverDoubt::Misplaced); }
    if (digest_of(positions) == said->digest) {
        rest->positions = std::move(positions);
    } else if (*ran > 0 || rest->place.along != Displacement{}) {
        return Doubt(TakeoverDoubt::Misplaced);
    }
    return rest;
}

}  // namespace lockstep
