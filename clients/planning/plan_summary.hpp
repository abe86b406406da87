// Plans a program without moving: its duration, its length and the load on each axis. The program may be of any length,
// because it is planned as a stream and planned parts are dropped.
#pragma once

#include <expected>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "clients/planning/plan_totals.hpp"
#include "core/coordinator/path/program_plan.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// The position of a homed machine: one place in mm per axis, each on a whole step.
std::vector<double> parked_mm(const MachineConfig& machine);

struct ProgramPlan {
    std::string program;
    std::vector<double> start_mm;
    int moves = 0;
    int pauses = 0;
    Ticks duration;  // of all legs, with dwells, without pauses
    double duration_s = 0;
    double length_mm = 0;  // along the path
    std::vector<AxisPlan> axes;
};

/// Start counts of every axis of the machine: the program's start if it names the axis, else the park position.
AxisCounts start_counts(const MachineConfig& machine, const ProgramHead& program);

struct PlannedFrame {
    const PathFrame& frame;
    Ticks begin;            // since the program's begin, without pauses
    bool is_first = false;  // of a leg, which starts from rest
};
using OnPlannedFrame = std::function<void(const PlannedFrame&)>;

/// Called from time to time with the time of the motion planned so far.
using OnPlanProgress = std::function<void(Ticks motion)>;

struct Planning {
    AxisCounts start;  // of all axes of the machine
    Overrides overrides;
    OnPlannedFrame each_frame;  // may be empty
    OnPlanProgress progress;    // may be empty
};

/// Plans the program as the coordinator does. Reads each block once, in order. Fails like ProgramPlanner::plan.
///
/// Without `each_frame`, times and figures are those of the planned path (core/path/timing/path_timer.hpp), and the
/// cost depends on the program and not on the duration of its motion. With it, they are those of the frames. Frames
/// last longer where they have no room for the pieces of the path: 0.02 % for a million lines of 0.05 to 1 mm. They
/// fail if the axes' limits contradict each other. The figures of the LAI method are the same in both cases.
std::expected<ProgramPlan, PlanError> plan_blocks(const MachineConfig& machine, const ProgramHead& head,
                                                  std::shared_ptr<const ProgramBlocks> blocks,
                                                  const Planning& planning);
/// Plans the program from its own start position.
std::expected<ProgramPlan, PlanError> plan_program(const MachineConfig& machine, const Program& program,
                                                   const OnPlannedFrame& each_frame = {});

/// `lines`: number of lines of the G-code file.
proto::PlanReport to_report(const ProgramPlan& plan, int lines);

}  // namespace lockstep
