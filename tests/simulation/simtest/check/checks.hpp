// The checks of a run. They know the configuration, the programs and the pulses. They share no formula with the code
// that they check.
#pragma once

#include "tests/simulation/simtest/record/follow.hpp"
#include "tests/simulation/simtest/record/recording.hpp"
#include "tests/simulation/simtest/record/violation.hpp"

namespace lockstep::simtest {

/// Exact: the steps of a completed job lead to its program's end, and no step is outside of a job. Starting at rest at
/// power-up, the steps add up.
Violations check_counts(const Recording& recording);

/// Within limits: a motion exists that keeps the axis's limits of speed, acceleration, deceleration and sudden change,
/// and that crosses every half step within the tick before the step.
///
/// For any two adjacent windows of steps, the mean speeds differ by at most a times the time between their middles,
/// plus one start velocity if joints of moves can be in them: over any stretch of time the speed changes by at most
/// one start velocity more than the acceleration does in that time. The mean of a window is computed with its time one
/// tick longer or shorter, and its way 0.08 step longer or shorter. All windows of 1, 4, 16 ... steps are checked, and
/// ramps beside rests with v^2 = v0^2 + 2 a s.
Violations check_limits(const Recording& recording, const Followings& followings);

/// Together: for every step the program's path has a place from which no axis is more than one step away, and these
/// places never go back. Half of this step is the error of rounding a place to whole steps. Moves between sharp corners
/// are not joined with others: there no axis is more than this half and 0.04 step away. A completed job has reached the
/// path's end. Rests are on whole steps.
Violations check_together(const Recording& recording, const Followings& followings);

/// Frames: every axis ran the same frames of each epoch and the same tail, in order, each once, at the time they were
/// sent for. It ran only armed frames, and made no step outside them.
///
/// If one fault may have separated its victim from the others (explain.hpp), the others ran the same frames, the victim
/// at most one frame more or less, and the machine reported it before it continued. Several faults at a time may
/// separate any axis, by at most one frame.
Violations check_frames(const Recording& recording);

/// Stops: after an emergency stop all pulses have ceased within kCeaseSlots; those of the device with
/// its input after the debounce, those of the others within kInputCeaseSlots. A motion is interrupted only by a fault
/// that the machine need not tolerate. An axis that moves by itself brakes within kHaltSlots and kHalt_ns of the
/// coordinator's order to halt: 30 ms with slots of 10 ms.
Violations check_stops(const Recording& recording);
inline constexpr int kCeaseSlots = 6;                 // two messages with a loop at both ends, and one coordinator slot
inline constexpr int kInputCeaseSlots = 10;           // also the state of the motor whose device was stopped
inline constexpr int kHaltSlots = 2;                  // one message, with a loop at both ends
inline constexpr std::int64_t kHalt_ns = 10'000'000;  // the frame in progress, and the time between two readings

/// Jogs: pulses cease in time after the release of the keys, or after the last renewal.
Violations check_jogs(const Recording& recording);

/// Owners: one owner at a time moves the axes. An axis moves only for the owner that it follows. An owner begins only
/// after all axes follow it. A previous owner never returns, and terms never decrease. No frame runs
/// twice or with other content than sent. No coordinator takes over from a healthy owner.
Violations check_owners(const Recording& recording);

/// Outputs: at each step a digital output has the level that the words before the place ask for, and the energy of one
/// that follows the speed is that of the way: the power at the feed for as long as the feed takes for it, whatever the
/// speed was. After a job that ended early, outputs are off that may not stay on.
Violations check_outputs(const Recording& recording, const Followings& followings);

/// A device makes a pulse at each place of M69 that its steps come to, and no other.
Violations check_pulses(const Recording& recording, const Followings& followings);

/// A probing move ends at the touch: it is reported at its time, each motor is where its steps had led by then, and the
/// way behind the touch is no longer than was announced.
Violations check_probes(const Recording& recording);

Violations check_all(const Recording& recording);

}  // namespace lockstep::simtest
