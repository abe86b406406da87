// The off-line scheme: the waits of all steps are computed and stored before the move, and a timer counts them out.
//
// Source: Daniel Carrica, Marcos A. Funes, Sergio A. González, "Novel stepper motor controller based on FPGA hardware
// implementation", Section I.A: what the paper compares its own method with. Its price there is hardware: a timer, and
// a memory that grows with the length of the move.
//
// Left open there and chosen here: step k is stored where the continuous ideal (core/motion/ideal.hpp) is at k, to the
// nearest count. The timer counts the clock periods of the paper's own method, so that the two differ by the method
// alone. A wait takes 32 bits.
#pragma once

#include "core/methods/method.hpp"

namespace lockstep::methods {

struct CarricaOffLineParameters {
    double timer_s = 800e-9;  // T_r of Eq. (3); T_c of Figs. 6 and 7
};

/// The memory: how many counts of the timer each step waits.
using CarricaTable = std::vector<std::uint32_t>;

/// Error: as carrica_off_line's.
std::expected<CarricaTable, StepError> carrica_table(const StepMove& move,
                                                     const CarricaOffLineParameters& parameters = {});

/// Expresses every move. Step k is where the position is k. Error: the maximum is above one step per count, or the move
/// lasts more counts than kMaxClocks.
StepResult carrica_off_line(const StepMove& move, Fit fit, const CarricaOffLineParameters& parameters = {});

}  // namespace lockstep::methods
