#include "core/coordinator/program/probe_check.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/coordinator/path/probe_cease.hpp"
#include "core/number_text.hpp"
#include "core/protocol/rules.hpp"

namespace lockstep {
namespace {

std::string rounded(double value) { return number_text(value, 4); }

/// See overshoot_mm().
double seconds_until_braking(const MachineConfig& machine, const InputConfig& input) {
    const ProtocolTiming& timing = machine.timing;
    const int slots = 2 + timing.stall_slots + timing.lease_slots() + timing.frame_slots;
    return input.debounce_ms * 1e-3 + slots * static_cast<double>(machine.timing.slot_us) * 1e-6;
}

std::expected<void, PlanError> refuse(const Block& block, std::string text) {
    return std::unexpected(PlanError{FaultCode::BadProgram, block.line, std::move(text)});
}

AxisSet moved_by(const ProgramMove& move, std::span<const AxisIndex> axes, std::span<const double> from_mm) {
    AxisSet moved;
    for (std::size_t i = 0; i < axes.size(); ++i) {
        if (move.target_mm[i] != from_mm[i]) { moved.insert(axes[i]); }
    }
    return moved;
}

/// How far the move goes on behind a touch, and the greatest feed with which that is allowed.
struct Overshoot {
    double behind_mm = 0;
    double most_mm_s = 0;
};

Overshoot overshoot_of(const ProgramMove& move, const Probe& probe, const MachineConfig& machine,
                       const InputConfig& input, AxisSet axes, const Braking& braking) {
    const double by = greatest_override(move);
    Overshoot found{overshoot_mm(machine, input, move.feed_mm_s * by, braking),
                    greatest_probing_feed_mm_s(machine, input, braking) / by};
    const Kinematics kinematics(machine);
    if (ceases_at_touch(probe, move, axes, machine, kinematics)) {
        found.behind_mm = ceased_overshoot_mm(machine, input, axes, kinematics, move.feed_mm_s * by);
    }
    const auto most = greatest_ceasing_feed_mm_s(probe, input, axes, machine, kinematics);
    if (most) { found.most_mm_s = std::max(found.most_mm_s, *most / by); }
    return found;
}

std::expected<void, PlanError> check_overshoot(const Block& block, const ProgramMove& move, const Overshoot& overshoot,
                                               const InputConfig& input) {
    const auto [behind, most] = overshoot;
    if (behind <= input.max_overshoot_mm) { return {}; }
    const double by = greatest_override(move);
    return refuse(block, "with F" + rounded(move.feed_mm_s * 60) + (by > 1 ? " and the greatest feed override" : "") +
                             " this probing move may go on for " + rounded(behind) +
                             " mm behind the touch, and max_overshoot_mm of input " + input.name + " is " +
                             rounded(input.max_overshoot_mm) + "; use at most F" +
                             rounded(std::floor(most * 600) / 10) +
                             ", or shorter slots (timing), or raise max_overshoot_mm if the probe bears it");
}

}  // namespace

double overshoot_mm(const MachineConfig& machine, const InputConfig& input, double feed_mm_s, const Braking& braking) {
    return feed_mm_s * seconds_until_braking(machine, input) + feed_mm_s * feed_mm_s / (2 * braking.mm_s2(feed_mm_s));
}

/// The positive root of v^2 / 2a + v t = s. If a falls with v, it is less.
double greatest_probing_feed_mm_s(const MachineConfig& machine, const InputConfig& input, const Braking& braking) {
    const double gained = braking.mm_s2(0) * seconds_until_braking(machine, input);
    double most = std::sqrt(gained * gained + 2 * braking.mm_s2(0) * input.max_overshoot_mm) - gained;
    if (braking.is_constant()) { return most; }
    double least = 0;
    for (int halvings = 0; halvings < 60; ++halvings) {
        const double middle = (least + most) / 2;
        (overshoot_mm(machine, input, middle, braking) <= input.max_overshoot_mm ? least : most) = middle;
    }
    return least;
}

Slot slots_until_known(const InputConfig& input, const MachineConfig& machine) {
    const double debounce = input.debounce_ms * 1e-3 * machine.ticks_per_second();
    return static_cast<Slot>(debounce / static_cast<double>(machine.slot_ticks().value)) + 3 + rules::kHopSlots;
}

std::expected<void, PlanError> ProbeCheck::next(const Block& block, const MachineConfig& machine,
                                                std::span<const AxisIndex> axes, std::span<const double> from_mm) {
    if (has_moved_) { return refuse(block, "a program ends with its probing move; send what follows it afterwards"); }
    if (const auto* probe = std::get_if<Probe>(&block.action); probe != nullptr && !probe_) {
        probe_ = *probe;
        if (!inputs_of_probe(machine.inputs, probe->input).empty()) { return {}; }
        return refuse(block, "probe " + std::to_string(probe->input) +
                                 " is not configured on this machine; write input { use: PROBE } with this number in "
                                 "the machine's file");
    }
    if (!probe_) { return {}; }
    const auto* const move = std::get_if<ProgramMove>(&block.action);
    if (move == nullptr || move->arc || move->rapid || move->target_mm.size() != axes.size()) {
        return refuse(block, "behind a probe must be one straight move with a feed");
    }
    has_moved_ = true;
    const Braking braking = Braking::of_move(machine, axes, from_mm, move->target_mm);
    const AxisSet moved = moved_by(*move, axes, from_mm);
    for (const InputConfig* const input : inputs_of_probe(machine.inputs, probe_->input)) {
        const Overshoot overshoot = overshoot_of(*move, *probe_, machine, *input, moved, braking);
        const auto fits = check_overshoot(block, *move, overshoot, *input);
        if (!fits) { return fits; }
    }
    return {};
}

}  // namespace lockstep
