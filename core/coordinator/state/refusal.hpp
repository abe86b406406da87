// Why a client's command is refused: with the value, the limit and the remedy, for a person.
#pragma once

#include <expected>
#include <string>

#include "core/coordinator/state/coordinator_loop.hpp"

namespace lockstep {

struct Refusal {
    FaultCode why = FaultCode::None;
    std::string text;
};

/// The result of a command: accepted, or refused.
using CommandResult = std::expected<void, Refusal>;
inline std::unexpected<Refusal> refuse(FaultCode why, std::string text) {
    return std::unexpected(Refusal{why, std::move(text)});
}

CommandResult check_present(const LoopView& loop);
CommandResult check_homed(const LoopView& loop);
/// Checks that the motors of each axis agree where it is.
CommandResult check_square(const LoopView& loop);
/// Checks that the axes agree on the time well enough for coordinated moves.
CommandResult check_clocks(const LoopView& loop);
/// The first of the machine's inputs that is closed and holds the machine, such as an open door; nullopt if there is
/// none.
std::optional<std::size_t> holding_input(const AxisRoster& axes);
/// Checks that no input holds the machine.
CommandResult check_holding_inputs(const LoopView& loop);
/// Checks that no axis is at a limit switch at which the coordinator stops the machine.
CommandResult check_limits(const LoopView& loop);
/// Checks that these jogs move no axis toward such a switch that is closed.
CommandResult check_jogs_at_limits(const std::vector<JogAxis>& jogs, const LoopView& loop);
/// Checks that no emergency stop is closed.
CommandResult check_emergency_stops(const LoopView& loop);
std::unexpected<Refusal> refuse_in_fault(FaultCode fault);
std::unexpected<Refusal> refuse_without_device(MotorIndex motor, const LoopView& loop);

}  // namespace lockstep
