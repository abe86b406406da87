// Where the motors of an axis are assumed to be while it homes by touch: for each move the axis is assumed elsewhere,
// and at the end it is where it truly is.
//
// Motors that move other axes too rest on whole steps, so an assumption places the other axes up to half a step of the
// motor away. While the axis homes this does not matter, if they stay within their travel. At the end all that was
// assumed is taken back at once, so these errors do not add up.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/coordinator/state/coordinator_loop.hpp"

namespace lockstep {

class AssumedPlace {
public:
    /// motors: of the machine.
    AssumedPlace(AxisIndex axis, std::size_t motors);

    /// Returns where the motors are assumed to be for a move of the axis from `place`. Only motors of the axis change.
    MotorCounts for_move(std::int64_t place, const LoopView& loop);
    /// Returns where the motors are, if the axis is truly at `place`, and the others where they were at the beginning,
    /// moved by what their motors have moved since.
    MotorCounts truth(std::int64_t place, const LoopView& loop) const;

private:
    AxisIndex axis_;
    StaticVector<std::int64_t, kMaxAxes> given_;  // by how many steps each motor was assumed elsewhere, in all
};

}  // namespace lockstep
