// The figures of a plan: the path in the plane of its first two axes, and each axis's planned speed. They are collected
// frame by frame, in bounded memory.
#pragma once

#include <vector>

#include "clients/drawing/figure.hpp"
#include "clients/drawing/motion_figures.hpp"
#include "clients/drawing/thinned.hpp"
#include "clients/planning/plan_summary.hpp"
#include "core/kinematics/kinematics.hpp"

namespace lockstep {

class PlanDrawing {
public:
    explicit PlanDrawing(const MachineConfig& machine);

    /// Frames must come in the order of the plan.
    void take(const PlannedFrame& planned);

    /// Axes X and Y if the machine has them, else its first two; a single axis is drawn against itself.
    drawing::Figure path(const ProgramPlan& plan) const;
    /// The pauses between legs are left out.
    drawing::Figure speed(const ProgramPlan& plan) const;

private:
    struct Axis {
        std::string name;
        double steps_per_mm = 1;
        double max_velocity_mm_s = 0;
        drawing::ThinnedCurve speed;  // mm/s over seconds
    };

    void add_speeds(const AxisTrack& track, Ticks begin, Axis& axis);
    void add_places(const PathFrame& frame);

    MachineConfig machine_;
    Kinematics kinematics_;
    double ticks_per_s_;
    std::vector<Axis> motors_;
    AxisIndex x_;  // the plane's axes
    AxisIndex y_;
    drawing::ThinnedPath path_;  // mm
};

}  // namespace lockstep
