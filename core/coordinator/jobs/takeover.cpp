#include "core/coordinator/jobs/takeover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace lockstep {
namespace {

using Doubt = std::unexpected<TakeoverDoubt>;

/// From the program's place: joining moves, whole steps, and the way along a move that is joined with others.
constexpr double kNear_steps = 3;

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

/// The leg with the place.
std::expected<JobRest, TakeoverDoubt> locate(std::vector<Leg> legs, const FrameRest& rest) {
    for (std::size_t leg = 0; leg < legs.size(); ++leg) {
        if (rest.place.block < legs[leg].first || rest.place.block >= legs[leg].end) { continue; }
        return JobRest{
            .legs = std::move(legs), .leg = leg, .leg_done = rest.last, .place = rest.place, .positions = {}};
    }
    return Doubt(TakeoverDoubt::OtherPlan);
}

using Places = std::vector<double>;  // mm, of each axis

/// Where the program's block leads, from there.
Places end_of(const Block& block, const Program& program, const MachineConfig& machine, Places from) {
    const auto* move = std::get_if<LinearMove>(&block.action);
    for (std::size_t i = 0; move != nullptr && i < program.axes.size(); ++i) {
        const auto named = std::ranges::find(machine.axes, program.axes[i], &AxisConfig::name);
        from[static_cast<std::size_t>(named - machine.axes.begin())] = move->target_mm[i];
    }
    return from;
}

/// Whether the axes are near the place by the program alone: the frames join moves within a step of it.
std::expected<void, TakeoverDoubt> check_place(const JobRest& rest, const Program& program,
                                               const MachineConfig& machine, std::span<const Position> at) {
    const Leg& leg = rest.legs[rest.leg];
    Places from;
    double near_mm = 0;
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        from.push_back(to_mm(machine.axes[i], static_cast<double>(leg.from[i])));
        near_mm = std::max(near_mm, kNear_steps / machine.axes[i].steps_per_mm);
    }
    for (std::uint32_t b = leg.first; b < rest.place.block; ++b) {
        from = end_of(program.blocks[b], program, machine, std::move(from));
    }
    const Places to = end_of(program.blocks[rest.place.block], program, machine, from);
    double square = 0;
    for (std::size_t i = 0; i < from.size(); ++i) { square += (to[i] - from[i]) * (to[i] - from[i]); }
    const double length = std::sqrt(square);
    const double along = rest.place.along.as_steps();  // mm
    if (along < 0 || along > length + near_mm) { return Doubt(TakeoverDoubt::OtherPlan); }
    for (std::size_t i = 0; rest.leg_done && i < from.size(); ++i) {
        const double end = to_mm(machine.axes[i], static_cast<double>(leg.to[i]));
        if (std::abs(to[i] - end) > near_mm) { return Doubt(TakeoverDoubt::OtherPlan); }
    }
    const double share = rest.leg_done ? 1 : length > 0 ? along / length : 0;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const double off = to_mm(machine.axes[i], at[i].as_steps()) - from[i] - share * (to[i] - from[i]);
        if (std::abs(off) > near_mm) { return Doubt(TakeoverDoubt::Misplaced); }
    }
    return {};
}

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
    if (const auto fits = check_place(*rest, program, machine, positions); !fits) { return Doubt(fits.error()); }
    const bool is_begin = rest->place == PathPlace{rest->legs[rest->leg].first, {}};
    if (digest_of(positions) == said->digest) {
        rest->positions = std::move(positions);
    } else if (*ran > 0 || !is_begin) {
        return Doubt(TakeoverDoubt::Misplaced);
    }
    return rest;
}

}  // namespace lockstep
