// The judges of a run. They know the configuration, the programs and the pulses, and share no formula with the code
// they judge.
#pragma once

#include "tests/simulation/simtest/record/recording.hpp"
#include "tests/simulation/simtest/record/violation.hpp"

namespace lockstep::simtest {

/// Exact: the steps of a job are those of its program, in order, none more; all of them where it was done. From rest
/// at power-up on, they add up.
Violations check_counts(const Recording& recording);

/// Within limits: there is a motion within the axis's speed, acceleration, deceleration and sudden change whose
/// half-step crossings all lie within the tick before their step.
///
/// For any two windows of steps that follow each other, their mean speeds differ by at most a times the time between
/// their middles, plus one start velocity for each joint of moves in them; means are bounded by times a tick longer
/// or shorter. All windows of 1, 4, 16 ... steps are judged. From rest and to rest likewise, with v^2 = v0^2 + 2 a s.
Violations check_limits(const Recording& recording);

/// Together: at every step there is a place on the program's path from which no axis is more than half a step off,
/// which is what rounding to whole steps makes of a place on the path itself.
Violations check_together(const Recording& recording);

/// Frames: every axis ran the same frames of each epoch, in order, each once, and the same tail, when they were sent
/// for; only what was armed; and made no step outside them.
///
/// Where one fault may have parted its victim from the others (explain.hpp), the others ran the same, the victim at
/// most a frame more or less, and the machine said so before it went on. More faults at a time may part anyone, by a
/// frame at most.
Violations check_frames(const Recording& recording);

/// Stops: after an emergency stop all pulses have ceased within kCeaseSlots, and no motion is interrupted unless what
/// went wrong is more than the machine must bear without.
Violations check_stops(const Recording& recording);
inline constexpr int kCeaseSlots = 6;  // two messages, each with a loop at both ends, and a slot of the coordinator

/// Owners: what moves the axes is one owner's at a time. No axis moves but for the owner that it follows, an owner
/// begins nothing before all axes follow it, one that has been followed by another never comes back, and terms never
/// fall. No frame is run twice, or other than it was sent. Nobody takes over from an owner that is well.
Violations check_owners(const Recording& recording);

Violations check_all(const Recording& recording);

}  // namespace lockstep::simtest
