// Every fault and refusal by number, stable name, cause and remedies: one table. Numbers are never reused. A remedy is
// an action of a person, and each client has its own words for it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace lockstep {

/// An action of a person against a fault or a refusal.
enum class Remedy : std::uint8_t {
    Wait,  // until the current activity has ended
    Home,
    Resume,
    Stop,
    Reset,
    Status,    // look at the state
    Again,     // repeat the refused command
    Timing,    // measure which slots the hosts need
    Incident,  // analyse the records of all processes about the incident
    RunRest,   // run the program from the line at which it ended
    Take       // repeat the refused command as a takeover of the machine
};

/// Remedies to apply in this order, or, if is_choice, any one of them.
struct Remedies {
    std::array<Remedy, 2> steps{};
    std::size_t count = 0;
    bool is_choice = false;

    constexpr std::span<const Remedy> list() const { return std::span(steps).first(count); }
};
constexpr Remedies in_order(Remedy only) { return {{only}, 1, false}; }
constexpr Remedies in_order(Remedy first, Remedy second) { return {{first, second}, 2, false}; }
constexpr Remedies either(Remedy one, Remedy other) { return {{one, other}, 2, true}; }

// X(name, number, text name, cause, what to check by hand first, remedies). {NAME} in the text for the hand stands for
// the words of the remedy with this name.
// clang-format off
#define LOCKSTEP_FAULTS(X) \
    X(NotHomed, 101, "not-homed", "an axis that must move has not been homed", \
      "", in_order(Remedy::Home)) \
    X(OutsideTravel, 102, "outside-travel", "a target lies outside an axis's travel", \
      "change the program, or the axis's position_min_mm / position_max_mm", {}) \
    X(LimitHit, 103, "limit-hit", "a limit switch closed", \
      "find out why the axis reached the switch", in_order(Remedy::Reset, Remedy::Home)) \
    X(FrameDiscontinuous, 104, "frame-discontinuous", "a frame did not start at the position and velocity of the axis's trajectory", \
      "the coordinator and the axis disagree: see their logs", in_order(Remedy::Reset)) \
    X(FrameBeyondLimits, 105, "frame-beyond-limits", "a frame would break an axis's speed or acceleration limit", \
      "check that coordinator and axes run the same configuration", in_order(Remedy::Reset)) \
    X(FrameOutsideTravel, 106, "frame-outside-travel", "a frame would leave an axis's travel", \
      "check that coordinator and axes run the same configuration", in_order(Remedy::Reset)) \
    X(AxisMissing, 107, "axis-missing", "no messages are received from an axis", \
      "start its lockstep-axis, or check the network", in_order(Remedy::Again)) \
    X(AxisLost, 108, "axis-lost", "an axis fell silent while moving", \
      "see the axis's log, and start its lockstep-axis if it is not running", in_order(Remedy::Reset, Remedy::Home)) \
    X(Busy, 109, "busy", "the machine is doing something else", \
      "", either(Remedy::Wait, Remedy::Stop)) \
    X(NothingToDo, 110, "nothing-to-do", "there is nothing to hold, resume or stop", \
      "", in_order(Remedy::Status)) \
    X(StartMismatch, 111, "start-mismatch", "the program was made for another start position", \
      "send it again from the machine's present position", {}) \
    X(BadProgram, 112, "bad-program", "the program cannot be read or planned", \
      "see the message with this code", {}) \
    X(HomeSwitchNotFound, 113, "home-switch-not-found", "the home switch did not close within the travel", \
      "check the switch, its position and the search direction", in_order(Remedy::Reset, Remedy::Home)) \
    X(HomeSwitchStuck, 114, "home-switch-stuck", "the home switch did not open during the pull-off", \
      "check the switch, or increase homing.pulloff_mm", in_order(Remedy::Reset, Remedy::Home)) \
    X(ConfigMismatch, 115, "config-mismatch", "an axis runs another configuration than the coordinator", \
      "give both the same file and restart them", in_order(Remedy::Reset)) \
    X(DeviceFault, 116, "device-fault", "the device refused a segment or lost a step's time", \
      "see the axis's log", in_order(Remedy::Reset, Remedy::Home)) \
    X(InFault, 117, "in-fault", "the machine is in Fault", \
      "", in_order(Remedy::Status, Remedy::Reset)) \
    X(EmergencyStopped, 118, "emergency-stopped", "an emergency stop was commanded", \
      "make sure that the machine is safe; an axis that was stopped in motion must be homed again", in_order(Remedy::Reset, Remedy::Home)) \
    X(UnknownProgram, 119, "unknown-program", "the named program has not arrived completely", \
      "send it again", {}) \
    X(SecondCoordinator, 120, "second-coordinator", "another coordinator runs this machine", \
      "stop one of them", {}) \
    X(FollowingError, 121, "following-error", "the encoder shows that steps were lost", \
      "lower the axis's speed or acceleration", in_order(Remedy::Reset, Remedy::Home)) \
    X(FrameLate, 122, "frame-late", "a frame arrived too late for the axes to run it", \
      "if it happens often, use longer slots: {timing}", in_order(Remedy::Reset)) \
    X(PositionMismatch, 123, "position-mismatch", "an axis is not where its frames end", \
      "see the axis's log", in_order(Remedy::Reset, Remedy::Home)) \
    X(FramesDiffer, 124, "frames-differ", "the axes ran different frames: an axis was cut off from the network, or the process of an axis stalled for longer than timing.stall_slots", \
      "find the axis: {incident}; then check its network, or use longer slots: {timing}", in_order(Remedy::Reset, Remedy::Home)) \
    X(ClockUncertain, 125, "clock-uncertain", "the error of an axis's clock may exceed timing.clock_error_limit_us", \
      "check the network to that axis, or increase timing.slot_us; for the error of each clock: {status}", in_order(Remedy::Reset)) \
    X(CoordinatorChanged, 126, "coordinator-changed", "another coordinator has taken over the machine since this command was given; the command may have begun", \
      "", in_order(Remedy::Status, Remedy::Again)) \
    X(PositionNotKept, 127, "position-not-kept", "no position of the axis has been kept", \
      "", in_order(Remedy::Home)) \
    X(PositionUnreadable, 128, "position-unreadable", "the axis's kept position cannot be read, or is damaged", \
      "see the axis's log", in_order(Remedy::Home)) \
    X(PositionForeign, 129, "position-foreign", "the kept position belongs to another machine or axis", \
      "give each machine a position_directory of its own", in_order(Remedy::Home)) \
    X(PositionRescaled, 130, "position-rescaled", "steps_per_mm or the home switch have changed in the configuration since the position was kept", \
      "", in_order(Remedy::Home)) \
    X(DevicePoweredUp, 131, "device-powered-up", "the axis's device was powered up after the position was kept", \
      "", in_order(Remedy::Home)) \
    X(DeviceHasRun, 132, "device-has-run", "the device has run, or had an order to run, since the axis's position was kept", \
      "", in_order(Remedy::Home)) \
    X(PositionPushed, 133, "position-pushed", "the encoder shows that the axis was moved without pulses", \
      "", in_order(Remedy::Home)) \
    X(HomeSwitchUnsteady, 134, "home-switch-unsteady", "the home switch closed at a different place at each touch", \
      "check whether the switch sticks, bounces or is loose, and whether the axis slips; or increase homing.touch_tolerance_mm", in_order(Remedy::Reset, Remedy::Home)) \
    X(DeviceLost, 135, "device-lost", "the axis's device stopped or was replaced, or its registers are not plausible", \
      "the axis's log names the device and the reason; make sure that the device runs", in_order(Remedy::Reset, Remedy::Home)) \
    X(DeviceMissing, 136, "device-missing", "the axis waits for its device", \
      "the axis's log names the device and the reason; start the device, and the axis connects to it by itself", in_order(Remedy::Again)) \
    X(NotAtRest, 137, "not-at-rest", "an axis has not come to rest although all its frames have ended", \
      "see the axis's log; restart its lockstep-axis if a reset does not help", in_order(Remedy::Reset, Remedy::Home)) \
    X(Held, 140, "held", "a job is held or paused", \
      "", either(Remedy::Resume, Remedy::Stop)) \
    X(NotReady, 141, "not-ready", "some axes do not follow the coordinator yet, or are not at rest", \
      "", in_order(Remedy::Wait, Remedy::Again)) \
    X(CoordinatorSilent, 142, "coordinator-silent", "an axis received nothing from the coordinator while it homed or moved on its own, so it halted", \
      "check that the coordinator runs and that the network connects it with the axis; if it has ended, its log gives the reason", in_order(Remedy::Reset, Remedy::Home)) \
    X(SenderSilent, 143, "sender-silent", "the sender of the program fell silent before the program's end", \
      "run the rest of the program: {run-rest}", {}) \
    X(ProgramNotKept, 144, "program-not-kept", "the coordinator cannot keep more of the program on its disk", \
      "make room on the coordinator's disk; run the rest of the program: {run-rest}", {}) \
    X(ProgramCutShort, 145, "program-cut-short", "the program's sender could not read it to its end", \
      "see the sender's message; run the rest of the program: {run-rest}", {}) \
    X(AwayFromPause, 146, "away-from-pause", "axes were moved in the pause, and the job continues only from the place where it paused", \
      "a resume first shows the way back, then moves the axes there", either(Remedy::Resume, Remedy::Stop)) \
    X(MotorsSkewed, 147, "motors-skewed", "the motors of an axis are not at the same place of it, or came apart by more than max_skew_mm while they homed", \
      "find out what holds the slower side back; the machine may be racked", in_order(Remedy::Reset, Remedy::Home)) \
    X(EmergencyStopInput, 148, "emergency-stop-input", "an emergency stop input of the axis's device is closed, or was", \
      "make sure that the machine is safe and release the emergency stop; axes that were stopped in motion must be homed again", in_order(Remedy::Reset, Remedy::Home)) \
    X(DoorOpen, 149, "door-open", "a door is open", \
      "close the door", in_order(Remedy::Again)) \
    X(WriterHeld, 150, "writer-held", "another writer has the machine; other clients can only watch, hold and stop it", \
      "wait until the writer gives it back; or take it over: {take}", {}) \
    X(OutputsImpossible, 151, "outputs-impossible", "a frame changes outputs in a way that the axis's device cannot", \
      "check that coordinator and axes are of the same version; please report it", in_order(Remedy::Reset, Remedy::Again)) \
    X(ProbeNotTouched, 152, "probe-not-touched", "a probing move came to its end without a touch", \
      "check the probe and its wire, and that the workpiece is where the move leads; a longer move searches further", in_order(Remedy::Again)) \
    X(ProbeTouchedEarly, 153, "probe-touched-early", "the probe touched before the probing move had begun", \
      "check the probe and its wire; move it away from what it touches", in_order(Remedy::Again)) \
    X(TouchInMotion, 154, "touch-in-motion", "a probe touched while the machine moved without a probing move", \
      "find out what it touched, and move the axes away after the reset; home them if they were pushed", in_order(Remedy::Reset)) \
    X(EncoderReversed, 155, "encoder-reversed", "the encoder counts against the direction of its motor", \
      "exchange the channels A and B of the encoder", in_order(Remedy::Reset, Remedy::Home)) \
    X(TouchMissed, 156, "touch-missed", "a motor did not stop at the touch of a probe, as its device had to do by itself", \
      "check the wire from the probe to the input at the device of this motor; the machine may have gone on behind the touch", in_order(Remedy::Reset, Remedy::Home))
// clang-format on

enum class FaultCode : std::uint16_t {
    None = 0,
#define X(name, number, text, cause, by_hand, remedies) name = number,
    LOCKSTEP_FAULTS(X)
#undef X
};

struct FaultText {
    FaultCode code;
    std::string_view name;
    std::string_view cause;
    std::string_view by_hand;  // empty: nothing to do by hand
    Remedies remedies;
};

/// Returns null for None and for numbers that are not in the table.
const FaultText* find_fault(FaultCode code);

/// Finds a fault by its stable name. Returns null if no fault has it.
const FaultText* find_fault(std::string_view name);

/// The stable name, such as "reset".
std::string_view name_of(Remedy remedy);

/// A client's words for an action.
using RemedyWords = std::string (*)(Remedy remedy);
/// Words without a client's commands, for texts that reach the users of any client.
std::string plain_words(Remedy remedy);
/// The name in braces, such as "{reset}". The reader of the text puts in its own words.
std::string words_to_fill_in(Remedy remedy);
/// Text for a person: what to check by hand, then the actions.
std::string remedy_text(const FaultText& fault, RemedyWords words = plain_words);

/// The fault of a board. A board is never homed, and the axes come to rest on their path and keep their positions. So
/// it has no remedy Home, unless it is an emergency stop, which may stop them in motion.
FaultText for_board(FaultText fault);

/// False for None, and for faults of the whole machine, which belong to no single axis.
constexpr bool is_of_an_axis(FaultCode code) {
    return code != FaultCode::None && code != FaultCode::EmergencyStopped && code != FaultCode::FrameLate &&
           code != FaultCode::SecondCoordinator;
}

constexpr bool is_emergency_stop(FaultCode code) {
    return code == FaultCode::EmergencyStopped || code == FaultCode::EmergencyStopInput;
}

/// The stable name, such as "not-homed"; "none" for None, "unknown" for numbers outside the table.
std::string_view name_of(FaultCode code);

}  // namespace lockstep
