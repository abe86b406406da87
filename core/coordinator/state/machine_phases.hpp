// The phases of the machine. Only a table decides which phase follows which; an event that the table does not list for
// a phase is a defect of the program.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/protocol/messages.hpp"
#include "core/protocol/transition_table.hpp"

namespace lockstep {

inline constexpr std::array kMachinePhases{
    MachinePhase::Standby, MachinePhase::Waiting, MachinePhase::Idle,    MachinePhase::Homing,   MachinePhase::Running,
    MachinePhase::Jogging, MachinePhase::Paused,  MachinePhase::Holding, MachinePhase::Stopping, MachinePhase::Fault};

enum class MachineEvent : std::uint8_t {
    Claimed,        // this coordinator owns the machine
    StoodDown,      // another coordinator owns it
    AxesReady,      // every axis is present with its device, follows this coordinator, has done its orders and rests
    AxisLacking,    // an axis or its device is missing, and nothing moves
    HomingBegins,   // axes home, group after group; again behind each move of an axis that homes by touch
    OwnMovesBegin,  // axes move to their places, each by itself, or motors make up lost steps before a leg
    JogBegins,      // clients move axes while they hold their keys
    EpochBegins,    // axes move together on a path
    StopAsked,      // a hold or a stop: the axes come to rest
    RestsOnPath,    // after a hold
    Pauses,         // between two legs of a program, or again after a job in this pause
    JobEnds,        // done or stopped
    FailsInMotion,  // a fault: the axes come to rest first
    Fails,          // a fault at rest, or the axes have come to rest after one
    Reset,
};
inline constexpr std::size_t kMachineEvents = 15;

struct MachineTransition {
    MachinePhase from;
    MachineEvent event;
    MachinePhase to;
};

inline constexpr std::array kMachineTransitions{
    // Standby: another coordinator owns the machine, or it is not known yet which one does.
    MachineTransition{MachinePhase::Standby, MachineEvent::Claimed, MachinePhase::Waiting},
    // Waiting: for axes, or with the job of the last owner. Nothing moves.
    MachineTransition{MachinePhase::Waiting, MachineEvent::AxesReady, MachinePhase::Idle},
    MachineTransition{MachinePhase::Waiting, MachineEvent::EpochBegins, MachinePhase::Running},
    MachineTransition{MachinePhase::Waiting, MachineEvent::Pauses, MachinePhase::Paused},
    MachineTransition{MachinePhase::Waiting, MachineEvent::JobEnds, MachinePhase::Idle},
    MachineTransition{MachinePhase::Waiting, MachineEvent::Fails, MachinePhase::Fault},
    MachineTransition{MachinePhase::Waiting, MachineEvent::Reset, MachinePhase::Waiting},
    MachineTransition{MachinePhase::Waiting, MachineEvent::StoodDown, MachinePhase::Standby},
    // Idle: a job can begin.
    MachineTransition{MachinePhase::Idle, MachineEvent::AxisLacking, MachinePhase::Waiting},
    MachineTransition{MachinePhase::Idle, MachineEvent::HomingBegins, MachinePhase::Homing},
    MachineTransition{MachinePhase::Idle, MachineEvent::OwnMovesBegin, MachinePhase::Running},
    MachineTransition{MachinePhase::Idle, MachineEvent::JogBegins, MachinePhase::Jogging},
    MachineTransition{MachinePhase::Idle, MachineEvent::EpochBegins, MachinePhase::Running},
    MachineTransition{MachinePhase::Idle, MachineEvent::Pauses, MachinePhase::Paused},
    MachineTransition{MachinePhase::Idle, MachineEvent::JobEnds, MachinePhase::Idle},
    MachineTransition{MachinePhase::Idle, MachineEvent::Fails, MachinePhase::Fault},
    MachineTransition{MachinePhase::Idle, MachineEvent::Reset, MachinePhase::Waiting},
    MachineTransition{MachinePhase::Idle, MachineEvent::StoodDown, MachinePhase::Standby},
    // In motion.
    MachineTransition{MachinePhase::Homing, MachineEvent::HomingBegins, MachinePhase::Homing},
    MachineTransition{MachinePhase::Homing, MachineEvent::EpochBegins, MachinePhase::Homing},
    MachineTransition{MachinePhase::Homing, MachineEvent::StopAsked, MachinePhase::Stopping},
    MachineTransition{MachinePhase::Homing, MachineEvent::JobEnds, MachinePhase::Idle},
    MachineTransition{MachinePhase::Homing, MachineEvent::FailsInMotion, MachinePhase::Stopping},
    MachineTransition{MachinePhase::Homing, MachineEvent::Fails, MachinePhase::Fault},
    MachineTransition{MachinePhase::Homing, MachineEvent::StoodDown, MachinePhase::Standby},
    MachineTransition{MachinePhase::Running, MachineEvent::EpochBegins, MachinePhase::Running},
    MachineTransition{MachinePhase::Running, MachineEvent::OwnMovesBegin, MachinePhase::Running},
    MachineTransition{MachinePhase::Running, MachineEvent::StopAsked, MachinePhase::Stopping},
    MachineTransition{MachinePhase::Running, MachineEvent::Pauses, MachinePhase::Paused},
    MachineTransition{MachinePhase::Running, MachineEvent::JobEnds, MachinePhase::Idle},
    MachineTransition{MachinePhase::Running, MachineEvent::FailsInMotion, MachinePhase::Stopping},
    MachineTransition{MachinePhase::Running, MachineEvent::Fails, MachinePhase::Fault},
    MachineTransition{MachinePhase::Running, MachineEvent::StoodDown, MachinePhase::Standby},
    MachineTransition{MachinePhase::Jogging, MachineEvent::StopAsked, MachinePhase::Stopping},
    MachineTransition{MachinePhase::Jogging, MachineEvent::Pauses, MachinePhase::Paused},
    MachineTransition{MachinePhase::Jogging, MachineEvent::JobEnds, MachinePhase::Idle},
    MachineTransition{MachinePhase::Jogging, MachineEvent::FailsInMotion, MachinePhase::Stopping},
    MachineTransition{MachinePhase::Jogging, MachineEvent::Fails, MachinePhase::Fault},
    MachineTransition{MachinePhase::Jogging, MachineEvent::StoodDown, MachinePhase::Standby},
    MachineTransition{MachinePhase::Stopping, MachineEvent::StopAsked, MachinePhase::Stopping},
    MachineTransition{MachinePhase::Stopping, MachineEvent::RestsOnPath, MachinePhase::Holding},
    MachineTransition{MachinePhase::Stopping, MachineEvent::Pauses, MachinePhase::Paused},
    MachineTransition{MachinePhase::Stopping, MachineEvent::JobEnds, MachinePhase::Idle},
    MachineTransition{MachinePhase::Stopping, MachineEvent::FailsInMotion, MachinePhase::Stopping},
    MachineTransition{MachinePhase::Stopping, MachineEvent::Fails, MachinePhase::Fault},
    MachineTransition{MachinePhase::Stopping, MachineEvent::StoodDown, MachinePhase::Standby},
    // A job waits for a person, and nothing moves. Holding: within a leg. Paused: between legs, where axes may be
    // jogged.
    MachineTransition{MachinePhase::Holding, MachineEvent::EpochBegins, MachinePhase::Running},
    MachineTransition{MachinePhase::Holding, MachineEvent::JobEnds, MachinePhase::Idle},
    MachineTransition{MachinePhase::Holding, MachineEvent::Fails, MachinePhase::Fault},
    MachineTransition{MachinePhase::Holding, MachineEvent::StoodDown, MachinePhase::Standby},
    MachineTransition{MachinePhase::Paused, MachineEvent::EpochBegins, MachinePhase::Running},
    MachineTransition{MachinePhase::Paused, MachineEvent::OwnMovesBegin, MachinePhase::Running},
    MachineTransition{MachinePhase::Paused, MachineEvent::JogBegins, MachinePhase::Jogging},
    MachineTransition{MachinePhase::Paused, MachineEvent::Pauses, MachinePhase::Paused},
    MachineTransition{MachinePhase::Paused, MachineEvent::JobEnds, MachinePhase::Idle},
    MachineTransition{MachinePhase::Paused, MachineEvent::Fails, MachinePhase::Fault},
    MachineTransition{MachinePhase::Paused, MachineEvent::StoodDown, MachinePhase::Standby},
    // Fault: until a person resets it.
    MachineTransition{MachinePhase::Fault, MachineEvent::Reset, MachinePhase::Waiting},
    MachineTransition{MachinePhase::Fault, MachineEvent::StoodDown, MachinePhase::Standby},
};

/// Returns the row of kMachineTransitions, or nullopt if the event cannot happen in this phase.
constexpr std::optional<std::size_t> find_transition(MachinePhase from, MachineEvent event) {
    return find_row(kMachineTransitions, from, event);
}

constexpr std::string_view name_of(MachineEvent event) {
    switch (event) {
        case MachineEvent::Claimed: return "Claimed";
        case MachineEvent::StoodDown: return "StoodDown";
        case MachineEvent::AxesReady: return "AxesReady";
        case MachineEvent::AxisLacking: return "AxisLacking";
        case MachineEvent::HomingBegins: return "HomingBegins";
        case MachineEvent::OwnMovesBegin: return "OwnMovesBegin";
        case MachineEvent::JogBegins: return "JogBegins";
        case MachineEvent::EpochBegins: return "EpochBegins";
        case MachineEvent::StopAsked: return "StopAsked";
        case MachineEvent::RestsOnPath: return "RestsOnPath";
        case MachineEvent::Pauses: return "Pauses";
        case MachineEvent::JobEnds: return "JobEnds";
        case MachineEvent::FailsInMotion: return "FailsInMotion";
        case MachineEvent::Fails: return "Fails";
        case MachineEvent::Reset: break;
    }
    return "Reset";
}

}  // namespace lockstep
