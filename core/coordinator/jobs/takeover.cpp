#include "core/coordinator/jobs/takeover.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/arc_path.hpp"
#include "core/enumeration.hpp"
#include "core/kinematics/axis_states.hpp"
#include "core/kinematics/kinematics.hpp"

namespace lockstep {
namespace {

using Doubt = std::unexpected<TakeoverDoubt>;

/// Allowed distance from the program's place: for joined moves, whole steps, and the distance along a joined move.
constexpr double kNear_steps = 3;
constexpr double kNear_share = 1e-4;  // of an arc's length: the lengths of its pieces may add up to a different length

bool is_in_doubt(const AxisView& axis) {
    return !axis.state || !axis.state->homed || axis.state->fault != FaultCode::None || !axis.state->at_rest;
}

/// Returns the last frame that all axes ran; 0: none of the epoch.
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

using Places = std::vector<double>;  // mm, of each axis of the machine

/// The places of the axes before a block of the program. Axes that the program does not name keep the places `from`
/// which the leg began. Where the motors rest on the way does not show them exactly, if the steps of motors that move
/// several axes are coarser than those of the axes.
Places places_before(std::uint32_t block, const KnownProgram& program, const MachineConfig& machine,
                     const AxisCounts& from) {
    const std::span<const double> named = program.place_before(block).value();
    Places places;
    for (std::size_t i = 0; i < from.size(); ++i) {
        const auto found = std::ranges::find(program.axes(), machine.axes[i].name);
        const auto place = static_cast<std::size_t>(found - program.axes().begin());
        const bool is_named = found != program.axes().end();
        places.push_back(is_named ? named[place] : to_mm(machine.axes[i], static_cast<double>(from[i])));
    }
    return places;
}

AxisCounts counts_of(const Places& places, const MachineConfig& machine) {
    AxisCounts counts;
    for (std::size_t i = 0; i < places.size(); ++i) { counts.append(to_steps(machine.axes[i], places[i])); }
    return counts;
}

/// Returns the end of the leg, `block` being the block of its last frame. The rest of the leg must move nothing.
std::expected<LegEnd, TakeoverDoubt> end_behind(const KnownProgram& program, const MachineConfig& machine,
                                                std::uint32_t block, AxisCounts at) {
    const ProgramPlanner planner(machine);
    for (LegEnd end{.block = block + 1, .to = at};; ++end.block) {
        if (program.ends_before(end.block)) { return end; }
        const Block* const next = program.block(end.block);
        if (next == nullptr) { return Doubt(TakeoverDoubt::UnknownProgram); }
        note_end(*next, end);
        if (ends_leg(*next)) { return end; }
        if (planner.moves(*next, program.places(), at)) { return Doubt(TakeoverDoubt::OtherPlan); }
    }
}

/// The move of a block with its ends, for each axis of the machine.
struct MoveWay {
    Places from;
    Places to;
    std::optional<ArcShape> arc;
    double tolerance_mm = 0;

    double length() const { return length_mm({.target_mm = to, .arc = arc}, from); }
    Places at(double share) const {
        if (arc) { return ArcPath(*arc, from, to).at(share); }
        Places place = from;
        for (std::size_t i = 0; i < from.size(); ++i) { place[i] += share * (to[i] - from[i]); }
        return place;
    }
};

MoveWay way_of(std::uint32_t block, const KnownProgram& program, const MachineConfig& machine, const AxisCounts& from) {
    MoveWay way{.from = places_before(block, program, machine, from),
                .to = places_before(block + 1, program, machine, from),
                .arc = {}};
    const Block* const known = program.block(block);
    const auto* move = known != nullptr ? std::get_if<ProgramMove>(&known->action) : nullptr;
    if (move == nullptr) { return way; }
    way.tolerance_mm = move->tolerance_mm;
    way.arc = move->arc;
    if (!way.arc) { return way; }
    way.arc->first = program.places()[way.arc->first];
    way.arc->second = program.places()[way.arc->second];
    return way;
}

/// Checks that the axes are near the place that the program alone gives. Frames join moves within a step of the
/// program, or within the tolerance that it gives.
std::expected<void, TakeoverDoubt> check_place(const FrameRest& rest, const MoveWay& way, const MachineConfig& machine,
                                               const Kinematics& kinematics, std::span<const double> axis_steps) {
    const double length = way.length();
    double near_mm = way.tolerance_mm + kNear_share * length;
    double most_mm = 0;
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        most_mm = std::max(most_mm, kNear_steps * kinematics.step_mm(i));
    }
    near_mm += most_mm;
    const double along = rest.place.along.as_steps();  // mm
    if (along < 0 || along > length + near_mm) { return Doubt(TakeoverDoubt::OtherPlan); }
    const Places place = way.at(rest.last ? 1 : length > 0 ? std::min(along / length, 1.0) : 0);
    for (std::size_t i = 0; i < place.size(); ++i) {
        const double off = to_mm(machine.axes[i], axis_steps[i]) - place[i];
        if (std::abs(off) > near_mm) { return Doubt(TakeoverDoubt::Misplaced); }
    }
    return {};
}

/// Devices may know places of M69, by words before a block, of which some pulses were made.
bool may_have_pulses(const MachineState& last, const KnownProgram& program, std::uint32_t before) {
    if (last.devices.pulses.left > 0) { return true; }
    for (std::uint32_t k = last.events_from; k < before; ++k) {
        const Block* const block = program.block(k);
        const auto* event = block != nullptr ? std::get_if<ProgramEvent>(&block->action) : nullptr;
        if (event != nullptr && event->kind == ProgramEvent::Kind::PulsePlaces && event->index > 0) { return true; }
    }
    return false;
}

}  // namespace

std::string_view text_of(TakeoverDoubt doubt) {
    return pick_name(
        {"a takeover stops the job; with --on-takeover continue it continues the job",
         "the job was held, paused, stopping or in a probing move, or it is not a program",
         "a hold or stop was commanded during the takeover", "this coordinator does not have the job's program",
         "the last owner's reports of the job do not match its program",
         "an axis is missing, was restarted, is not homed or has a fault", "the axes did not all run the same frames",
         "the axes ran frames for which no message of the last owner was received",
         "an axis is not where its frames end",
         "the job makes pulses at places, and only its last owner knew how many are left"},
        doubt);
}

bool is_at_hand(const MachineState& last, const KnownProgram& program) {
    bool are_all = true;
    for (const FrameRest& rest : last.rests) {
        const std::uint32_t block = rest.place.block;
        if (block >= program.known() || block < program.first_kept()) { continue; }
        const auto leg = program.leg_of(block);
        are_all = program.place_before(block) && program.block(block) != nullptr && are_all;
        are_all = (!leg || program.place_before(*leg)) && are_all;
        for (std::uint32_t next = block + 1; rest.last && are_all && next < program.known(); ++next) {
            const Block* const behind = program.block(next);
            are_all = behind != nullptr;
            if (behind == nullptr || !std::holds_alternative<ProgramEvent>(behind->action)) { break; }
        }
    }
    return are_all;
}

std::expected<JobRest, TakeoverDoubt> rest_of_job(const MachineState& last, const KnownProgram& program,
                                                  const MachineConfig& machine, std::span<const AxisView> motors) {
    const auto ran = last_frame(last, motors);
    if (!ran) { return Doubt(ran.error()); }
    const auto said = std::ranges::find(last.rests, *ran, &FrameRest::frame);
    if (said == last.rests.end()) { return Doubt(TakeoverDoubt::UnreceivedFrames); }
    const std::uint32_t block = said->place.block;
    const auto first = program.leg_of(block);
    if (program.ends_before(block) || last.leg_from.size() != machine.axes.size()) {
        return Doubt(TakeoverDoubt::OtherPlan);
    }
    if (block >= program.known() || !first || *first < program.first_kept()) {
        return Doubt(TakeoverDoubt::UnknownProgram);
    }
    if (may_have_pulses(last, program, block)) { return Doubt(TakeoverDoubt::Pulses); }
    const Kinematics kinematics(machine);
    MotorPositions positions;
    MotorPositions slides;
    for (const AxisView& motor : motors) {
        positions.append(motor.state->position);
        slides.append(slide_of(*motor.state));
    }
    Places axis_steps;
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        axis_steps.push_back(kinematics.axis_steps(i, {slides.begin(), slides.size()}));
    }
    JobRest rest{.first = *first,
                 .from = counts_of(places_before(*first, program, machine, last.leg_from), machine),
                 .done = {},
                 .place = said->place,
                 .positions = {}};
    const MoveWay way = way_of(block, program, machine, last.leg_from);
    const auto fits = check_place(*said, way, machine, kinematics, axis_steps);
    if (!fits) { return Doubt(fits.error()); }
    if (said->last) {
        const auto end = end_behind(program, machine, block, counts_of(way.to, machine));
        if (!end) { return Doubt(end.error()); }
        rest.done = *end;
    }
    if (digest_of(positions) == said->digest) {
        rest.positions = positions;
    } else if (*ran > 0 || rest.place != PathPlace{rest.first, {}}) {
        return Doubt(TakeoverDoubt::Misplaced);
    }
    return rest;
}

}  // namespace lockstep
