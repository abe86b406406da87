// Checks the probing moves of a program when its blocks arrive, before anything moves.
#pragma once

#include <expected>
#include <optional>
#include <span>

#include "core/coordinator/path/braking.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep {

/// How far a move may go on behind a touch if a veto ends it, in mm. From the touch on, its speed is kept for at most
/// the debounce of the input, two slots until the axis's state carries the veto, a stall of its process, the lease, and
/// a frame (docs/protocol.md). Then the tail brakes it. `feed_mm_s`: along the move. Infinite if at
/// this feed no deceleration is sure.
double overshoot_mm(const MachineConfig& machine, const InputConfig& input, double feed_mm_s, const Braking& braking);

/// The greatest feed for which overshoot_mm() is at most max_overshoot_mm; 0: it never is.
double greatest_probing_feed_mm_s(const MachineConfig& machine, const InputConfig& input, const Braking& braking);

/// Within so many slots every change of an input is known from the states of its axis: the input follows its pin, the
/// device is read, the axis decides, publishes, and its state arrives.
Slot slots_until_known(const InputConfig& input, const MachineConfig& machine);

class ProbeCheck {
public:
    /// `axes`: those of the machine that the program names. Call it for all blocks, in order, with the place where each
    /// begins. Errors: an input that the machine lacks; something else than one straight move with a feed behind the
    /// Probe; a move that may go on too far behind the touch.
    std::expected<void, PlanError> next(const Block& block, const MachineConfig& machine,
                                        std::span<const AxisIndex> axes, std::span<const double> from_mm);

private:
    std::optional<Probe> probe_;  // asked for
    bool has_moved_ = false;      // and its move is known
};

}  // namespace lockstep
