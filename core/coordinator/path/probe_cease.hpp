// Which probing moves end at their touch, and not behind it by the veto: those of motors whose own devices all see the
// probe's switch. Each device ends the pulses at the first tick at which its input, debounced, has touched.
#pragma once

#include <optional>

#include "core/indices.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"

namespace lockstep {

/// Whether a move with this probe, which moves only these axes, ends at the touch: with any override the speed of each
/// motor is at most its start velocity, so that it loses no step when its pulses cease.
bool ceases_at_touch(const Probe& probe, const ProgramMove& move, AxisSet axes, const MachineConfig& machine,
                     const Kinematics& kinematics);

/// The greatest share of its feed at which a move may run.
double greatest_override(const ProgramMove& move);

/// How far such a move goes on behind the touch, in mm. A step of each motor is added, because motors rest on steps.
double ceased_overshoot_mm(const MachineConfig& machine, const InputConfig& input, AxisSet axes,
                           const Kinematics& kinematics, double feed_mm_s);

/// The greatest speed of a move with this probe that moves only these axes, ends at the touch, and goes on behind it by
/// no more than the input's max_overshoot_mm; nullopt if no such move ends at the touch.
std::optional<double> greatest_ceasing_feed_mm_s(const Probe& probe, const InputConfig& input, AxisSet axes,
                                                 const MachineConfig& machine, const Kinematics& kinematics);

}  // namespace lockstep
