// The plan of a program: its duration, its length and the load on each axis. Nothing moves. The program may be of any
// length: it is planned as a stream, and what has been planned is forgotten.
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
    Ticks duration;  // of all legs, dwells included; pauses are not
    double duration_s = 0;
    double length_mm = 0;  // along the path
    std::vector<AxisPlan> axes;
};

/// Counts for every axis of the machine: the program's start if it names the axis, else the park position.
AxisCounts start_counts(const MachineConfig& machine, const ProgramHead& program);

struct PlannedFrame {
    const PathFrame& frame;
    Ticks begin;            // since the begin of the program; pauses are left out
    bool is_first = false;  // of a leg: the machine comes from rest
};
using OnPlannedFrame = std::function<void(const PlannedFrame&)>;

struct Planning {
    AxisCounts start;  // of all axes of the machine
    Overrides overrides;
    OnPlannedFrame each_frame;  // may be none
};

/// Plans the program as the coordinator does. The blocks are read once, in their order. Errors: as
/// ProgramPlanner::plan; the axes' limits contradict each other.
std::expected<ProgramPlan, PlanError> plan_blocks(const MachineConfig& machine, const ProgramHead& head,
                                                  std::shared_ptr<const ProgramBlocks> blocks,
                                                  const Planning& planning);
/// From its start position.
std::expected<ProgramPlan, PlanError> plan_program(const MachineConfig& machine, const Program& program,
                                                   const OnPlannedFrame& each_frame = {});

/// `lines`: of the G-code file.
proto::PlanReport to_report(const ProgramPlan& plan, int lines);

}  // namespace lockstep
