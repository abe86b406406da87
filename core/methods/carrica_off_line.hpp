// The off-line scheme: the waits of all steps are computed and stored before the move, and a timer counts them.
//
// Source: Daniel Carrica, Marcos A. Funes, Sergio A. González, "Novel stepper motor controller based on FPGA hardware
// implementation", Section I.A. The paper compares its own method with this scheme, which needs more hardware: a timer,
// and a memory that grows with the length of the move.
//
// The paper leaves the following open; chosen here: step k is stored at the time at which the continuous ideal
// (core/motion/ideal.hpp) is at k, to the nearest count. The timer counts the clock periods of the paper's own method,
// so that only the methods differ. A wait takes 32 bits.
#pragma once

#include "core/methods/method.hpp"

namespace lockstep::methods {

struct CarricaOffLineParameters {
    double timer_s = 800e-9;  // T_r of Eq. (3); T_c of Figs. 6 and 7
};

/// The memory: the wait of each step in counts of the timer.
using CarricaTable = std::vector<std::uint32_t>;

/// Returns the errors of carrica_off_line().
std::expected<CarricaTable, StepError> carrica_table(const StepMove& move,
                                                     const CarricaOffLineParameters& parameters = {});

/// Expresses every move. Step k is at position k. Returns an error if the maximum is above one step per count, or the
/// move lasts more counts than kMaxClocks.
StepResult carrica_off_line(const StepMove& move, Fit fit, const CarricaOffLineParameters& parameters = {});

}  // namespace lockstep::methods
