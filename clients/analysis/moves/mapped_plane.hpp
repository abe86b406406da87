// The axes X and Y of a machine whose motors are not its axes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "clients/analysis/moves/job_moves.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"

namespace lockstep::analysis {

struct MappedPlane {
    std::shared_ptr<const Kinematics> kinematics;
    AxisIndex x;
    AxisIndex y;
    double x_scale = 1;  // steps as in MoveMeter::plane(), for each of the axis
    double y_scale = 1;
    std::vector<std::int64_t> counts;  // of the motors, after the traced steps
};

/// nullopt if each motor is an axis, if the job has no program, or if the machine lacks an axis of the plane.
std::optional<MappedPlane> mapped_plane(const MachineConfig& machine, const JobMoves& moves);

}  // namespace lockstep::analysis
