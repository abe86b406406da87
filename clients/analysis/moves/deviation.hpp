// The unit of a move's length and of its deviation from the commanded path. Axes slide in mm or rotate in degrees.
//
// If both kinds take part in a move, length and deviation are the root of the sum of the squares of mm and degrees. The
// deviation then limits each part: it is at most so many mm, and at most so many degrees.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/analysis/moves/job_moves.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"

namespace lockstep::analysis {

enum class MotionUnit : std::uint8_t { Mm, Deg, MmAndDeg };

/// "mm", "deg", "mm and deg"
std::string_view name_of(MotionUnit unit);

/// The unit of the axes that the motors move which have steps in the move, commanded or made. Mm without any.
MotionUnit motion_unit(const MachineConfig& machine, const Kinematics& kinematics, const MoveLog& move);

struct Deviation {
    MotionUnit unit = MotionUnit::Mm;
    double largest = 0;
};

/// At most one for each unit, in the order of units.
using Deviations = std::vector<Deviation>;

/// The largest deviation of a job's moves, for each unit. Empty if it is not known.
///
/// `moves`: the kept ones of `move_count`; `largest`: of all. If not all are kept, the units of the others are not
/// known: then the result is `largest`, in a unit that is true for all axes of the machine.
Deviations deviations(const MachineConfig& machine, const Kinematics& kinematics, std::span<const MoveLog> moves,
                      std::int64_t move_count, std::optional<double> largest);

/// Keeps the larger one for each unit.
void add(Deviations& all, const Deviations& more);

/// "0.0125 mm", "0.0256 deg", "0.0239 mm and 0.0239 deg"; with a comma between several.
std::string to_text(const Deviations& found);

}  // namespace lockstep::analysis
