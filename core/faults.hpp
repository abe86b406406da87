// Every fault and refusal by number, stable name, cause and remedy: one table. Numbers are never reused.
#pragma once

#include <cstdint>
#include <string_view>

namespace lockstep {

// X(name, number, text name, cause, remedy)
#define LOCKSTEP_FAULTS(X)                                                                                            \
    X(NotHomed, 101, "not-homed", "an axis that must move has not been homed", "home it: lockstep home")              \
    X(OutsideTravel, 102, "outside-travel", "a target lies outside an axis's travel",                                 \
      "change the program, or the axis's position_min_mm / position_max_mm")                                          \
    X(LimitHit, 103, "limit-hit", "a limit switch closed",                                                            \
      "see why the axis ran there, then: lockstep reset, lockstep home")                                              \
    X(FrameDiscontinuous, 104, "frame-discontinuous", "a frame did not start where the axis's trajectory then is",    \
      "a coordinator and an axis disagree; lockstep reset")                                                           \
    X(FrameBeyondLimits, 105, "frame-beyond-limits", "a frame would break an axis's speed or acceleration limit",     \
      "check that coordinator and axes run the same configuration")                                                   \
    X(FrameOutsideTravel, 106, "frame-outside-travel", "a frame would leave an axis's travel",                        \
      "check that coordinator and axes run the same configuration")                                                   \
    X(AxisMissing, 107, "axis-missing", "an axis is not heard", "start its lockstep-axis, or check the network")      \
    X(AxisLost, 108, "axis-lost", "an axis fell silent while moving", "see its log, then: lockstep reset")            \
    X(Busy, 109, "busy", "the machine is doing something else", "wait, or: lockstep stop")                            \
    X(NothingToDo, 110, "nothing-to-do", "there is nothing to hold, resume or stop", "see: lockstep status")          \
    X(StartMismatch, 111, "start-mismatch", "the program was made for another start position",                        \
      "send it again from where the machine stands")                                                                  \
    X(BadProgram, 112, "bad-program", "the program cannot be read or planned", "see the text beside this code")       \
    X(HomeSwitchNotFound, 113, "home-switch-not-found", "the home switch did not close within the travel",            \
      "check the switch, its position and the search direction")                                                      \
    X(HomeSwitchStuck, 114, "home-switch-stuck", "the home switch did not open on pulling off",                       \
      "check the switch, or make pulloff_mm longer")                                                                  \
    X(ConfigMismatch, 115, "config-mismatch", "an axis runs another configuration than the coordinator",              \
      "give both the same file and restart them")                                                                     \
    X(DeviceFault, 116, "device-fault", "the device refused a segment or lost a step's time",                         \
      "see the axis's log; lockstep reset")                                                                           \
    X(InFault, 117, "in-fault", "the machine is in Fault", "see why with lockstep status, then: lockstep reset")      \
    X(EmergencyStopped, 118, "emergency-stopped", "an emergency stop was commanded",                                  \
      "lockstep reset; the homing is suspect: lockstep home")                                                         \
    X(UnknownProgram, 119, "unknown-program", "the program named has not arrived whole", "send it again")             \
    X(SecondCoordinator, 120, "second-coordinator", "another coordinator runs this machine", "stop one of them")      \
    X(FollowingError, 121, "following-error", "the encoder says that steps were lost",                                \
      "lower the axis's speed or acceleration, then: lockstep reset, lockstep home")                                  \
    X(FrameLate, 122, "frame-late", "a frame came too late to be armed",                                              \
      "the machine comes to rest by itself; "                                                                         \
      "give the slots more time in the configuration if it happens often")                                            \
    X(PositionMismatch, 123, "position-mismatch", "an axis is not where its frames end",                              \
      "see its log; lockstep reset, lockstep home")                                                                   \
    X(FramesDiffer, 124, "frames-differ", "the axes did not all run the same frames: one was cut off",                \
      "check the network; lockstep reset, lockstep home")                                                             \
    X(ClockUncertain, 125, "clock-uncertain", "an axis's clock may be further off than timing.clock_error_limit_us",  \
      "check the network to that axis, or give the slots more time; lockstep status shows each clock's error; "       \
      "lockstep reset")                                                                                               \
    X(CoordinatorChanged, 126, "coordinator-changed",                                                                 \
      "another coordinator has taken the machine over since this was asked; it was perhaps begun",                    \
      "see: lockstep status; then ask again")                                                                         \
    X(PositionNotKept, 127, "position-not-kept", "no position of the axis has been kept", "home it: lockstep home")   \
    X(PositionUnreadable, 128, "position-unreadable", "the axis's kept position cannot be read, or is damaged",       \
      "see its log; lockstep home")                                                                                   \
    X(PositionForeign, 129, "position-foreign", "the kept position is of another machine or axis",                    \
      "give each machine a position_directory of its own; lockstep home")                                             \
    X(PositionRescaled, 130, "position-rescaled",                                                                     \
      "steps_per_mm or the home switch have been configured anew since the position was kept",                        \
      "home it: lockstep home")                                                                                       \
    X(DevicePoweredUp, 131, "device-powered-up", "the axis's device was powered up after the position was kept",      \
      "home it: lockstep home")                                                                                       \
    X(DeviceHasRun, 132, "device-has-run", "the device has run, or was about to, since the axis's position was kept", \
      "home it: lockstep home")                                                                                       \
    X(PositionPushed, 133, "position-pushed", "the encoder says that the axis was moved without pulses",              \
      "home it: lockstep home")                                                                                       \
    X(HomeSwitchUnsteady, 134, "home-switch-unsteady", "the home switch closed at another place with every touch",    \
      "see whether the switch sticks, bounces or slips, or the slide; or raise homing.touch_tolerance_mm")            \
    X(DeviceLost, 135, "device-lost", "the axis's device died, was exchanged, or its registers make no sense",        \
      "the axis's log says which device and why; see that it runs, then: lockstep reset, lockstep home")              \
    X(DeviceMissing, 136, "device-missing", "the axis waits for its device",                                          \
      "the axis's log says for which, and why; start it: the axis takes it by itself")                                \
    X(NotAtRest, 137, "not-at-rest", "an axis has not come to rest though all its frames are over",                   \
      "see its log; lockstep reset; if that does not help, restart its lockstep-axis, then: lockstep home")

enum class FaultCode : std::uint16_t {
    None = 0,
#define X(name, number, text, cause, remedy) name = number,
    LOCKSTEP_FAULTS(X)
#undef X
};

struct FaultText {
    FaultCode code;
    std::string_view name;
    std::string_view cause;
    std::string_view remedy;
};

/// Null for None and for numbers that are not in the table.
const FaultText* find_fault(FaultCode code);

/// By its stable name; null where there is none such.
const FaultText* find_fault(std::string_view name);

/// "not-homed" and the like; "none" for None, "unknown" outside the table.
std::string_view name_of(FaultCode code);

}  // namespace lockstep
