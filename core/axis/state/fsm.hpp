// The axis's six states and Fault. Only a table decides which state follows which.
//
// After Lam Chee Yuen and Phaklen Ehkan, "Design and Implementation of FPGA Based Bipolar Stepper Motor Controller for
// Linear Slide Application": Initialize, Standby, Accelerate, Cruise, Decelerate, Stop.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/enumeration.hpp"
#include "core/protocol/names.hpp"
#include "core/protocol/transition_table.hpp"

namespace lockstep {

inline constexpr std::array kAxisPhases{AxisPhase::Initialize, AxisPhase::Standby,    AxisPhase::Accelerate,
                                        AxisPhase::Cruise,     AxisPhase::Decelerate, AxisPhase::Stop,
                                        AxisPhase::Fault};

enum class AxisEvent : std::uint8_t {
    SpeedRises,  // the pulses come faster than before, also from rest
    SpeedSteady,
    SpeedFalls,
    MotionEnds,    // at rest, as planned
    SwitchStops,   // the home switch ended the search or the latch
    LimitStops,    // a limit switch ended the motion
    HostStops,     // an emergency stop ended it
    PositionKept,  // the device has proved the position that was kept at rest
    Zeroed,        // the zero is set, after a stop at the switch or in place; homing parks the axis
    Released,      // after a limit or emergency stop: back to Initialize, to be homed again
    HomingBegins,
    Fails,
    ResetHomed,    // out of Fault, position still known
    ResetUnhomed,  // out of Fault, to be homed again
};
inline constexpr std::size_t kAxisEvents = kCountOf<AxisEvent>;

struct AxisTransition {
    AxisPhase from;
    AxisEvent event;
    AxisPhase to;
};

/// All transitions. An event that is not listed for a state changes nothing, if it may come there (may_come).
inline constexpr std::array kAxisTransitions{
    // Initialize: unhomed, or searching, pulling off and latching.
    AxisTransition{AxisPhase::Initialize, AxisEvent::HomingBegins, AxisPhase::Initialize},
    AxisTransition{AxisPhase::Initialize, AxisEvent::SwitchStops, AxisPhase::Stop},
    AxisTransition{AxisPhase::Initialize, AxisEvent::LimitStops, AxisPhase::Stop},
    AxisTransition{AxisPhase::Initialize, AxisEvent::HostStops, AxisPhase::Stop},
    AxisTransition{AxisPhase::Initialize, AxisEvent::Fails, AxisPhase::Fault},
    AxisTransition{AxisPhase::Initialize, AxisEvent::PositionKept, AxisPhase::Standby},
    AxisTransition{AxisPhase::Initialize, AxisEvent::Zeroed, AxisPhase::Standby},  // in place
    // Standby: homed, at rest. From rest the speed can only rise.
    AxisTransition{AxisPhase::Standby, AxisEvent::HomingBegins, AxisPhase::Initialize},
    AxisTransition{AxisPhase::Standby, AxisEvent::SpeedRises, AxisPhase::Accelerate},
    AxisTransition{AxisPhase::Standby, AxisEvent::HostStops, AxisPhase::Stop},
    AxisTransition{AxisPhase::Standby, AxisEvent::LimitStops, AxisPhase::Stop},
    AxisTransition{AxisPhase::Standby, AxisEvent::Fails, AxisPhase::Fault},
    // In motion.
    AxisTransition{AxisPhase::Accelerate, AxisEvent::SpeedSteady, AxisPhase::Cruise},
    AxisTransition{AxisPhase::Accelerate, AxisEvent::SpeedFalls, AxisPhase::Decelerate},
    AxisTransition{AxisPhase::Accelerate, AxisEvent::MotionEnds, AxisPhase::Standby},
    AxisTransition{AxisPhase::Accelerate, AxisEvent::LimitStops, AxisPhase::Stop},
    AxisTransition{AxisPhase::Accelerate, AxisEvent::HostStops, AxisPhase::Stop},
    AxisTransition{AxisPhase::Accelerate, AxisEvent::Fails, AxisPhase::Fault},
    AxisTransition{AxisPhase::Cruise, AxisEvent::SpeedRises, AxisPhase::Accelerate},
    AxisTransition{AxisPhase::Cruise, AxisEvent::SpeedFalls, AxisPhase::Decelerate},
    AxisTransition{AxisPhase::Cruise, AxisEvent::MotionEnds, AxisPhase::Standby},
    AxisTransition{AxisPhase::Cruise, AxisEvent::LimitStops, AxisPhase::Stop},
    AxisTransition{AxisPhase::Cruise, AxisEvent::HostStops, AxisPhase::Stop},
    AxisTransition{AxisPhase::Cruise, AxisEvent::Fails, AxisPhase::Fault},
    AxisTransition{AxisPhase::Decelerate, AxisEvent::SpeedRises, AxisPhase::Accelerate},
    AxisTransition{AxisPhase::Decelerate, AxisEvent::SpeedSteady, AxisPhase::Cruise},
    AxisTransition{AxisPhase::Decelerate, AxisEvent::MotionEnds, AxisPhase::Standby},
    AxisTransition{AxisPhase::Decelerate, AxisEvent::LimitStops, AxisPhase::Stop},
    AxisTransition{AxisPhase::Decelerate, AxisEvent::HostStops, AxisPhase::Stop},
    AxisTransition{AxisPhase::Decelerate, AxisEvent::Fails, AxisPhase::Fault},
    // Stop: pulses have ceased at a switch or by command.
    AxisTransition{AxisPhase::Stop, AxisEvent::Zeroed, AxisPhase::Standby},
    AxisTransition{AxisPhase::Stop, AxisEvent::Released, AxisPhase::Initialize},
    AxisTransition{AxisPhase::Stop, AxisEvent::HomingBegins, AxisPhase::Initialize},
    AxisTransition{AxisPhase::Stop, AxisEvent::Fails, AxisPhase::Fault},
    // Fault: latched until a person resets it.
    AxisTransition{AxisPhase::Fault, AxisEvent::ResetHomed, AxisPhase::Standby},
    AxisTransition{AxisPhase::Fault, AxisEvent::ResetUnhomed, AxisPhase::Initialize},
};

/// Returns the row of kAxisTransitions, or nullopt if the event means nothing in this state.
constexpr std::optional<std::size_t> find_transition(AxisPhase from, AxisEvent event) {
    return find_row(kAxisTransitions, from, event);
}

/// Whether an event may come in a state that has no transition for it. Elsewhere it is a defect: an axis would be homed
/// and never ready. Fault is latched, whatever comes.
constexpr bool may_come(AxisPhase state, AxisEvent event) {
    if (state == AxisPhase::Fault) { return true; }
    switch (event) {
        case AxisEvent::SpeedRises:  // the device reports speed and stops in any state
        case AxisEvent::SpeedSteady:
        case AxisEvent::SpeedFalls:
        case AxisEvent::MotionEnds:
        case AxisEvent::SwitchStops:
        case AxisEvent::LimitStops:
        case AxisEvent::HostStops:
        case AxisEvent::Fails: return true;
        case AxisEvent::PositionKept:  // the axis decides these itself
        case AxisEvent::Zeroed:
        case AxisEvent::Released:
        case AxisEvent::HomingBegins: return false;
        case AxisEvent::ResetHomed: return state == AxisPhase::Standby;  // without a fault there is nothing to leave
        case AxisEvent::ResetUnhomed: return state == AxisPhase::Initialize;
    }
    return false;
}

/// Returns the state that follows, or nullopt if the event means nothing in this state.
constexpr std::optional<AxisPhase> next_phase(AxisPhase from, AxisEvent event) {
    const auto row = find_transition(from, event);
    return row ? std::optional(kAxisTransitions[*row].to) : std::nullopt;
}

constexpr std::string_view name_of(AxisEvent event) {
    return pick_name({"SpeedRises", "SpeedSteady", "SpeedFalls", "MotionEnds", "SwitchStops", "LimitStops", "HostStops",
                      "PositionKept", "Zeroed", "Released", "HomingBegins", "Fails", "ResetHomed", "ResetUnhomed"},
                     event);
}

}  // namespace lockstep
