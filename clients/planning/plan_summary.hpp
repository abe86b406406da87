// The plan of a program: its duration, its length and the load on each axis. Nothing moves.
#pragma once

#include <expected>
#include <string>
#include <vector>

#include "clients/planning/leg_plan.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// The position of a homed machine: one place in mm per axis, each on a whole step.
std::vector<double> parked_mm(const MachineConfig& machine);

struct AxisPlan {
    std::string name;
    std::int64_t steps = 0;  // both ways together
    double peak_velocity_mm_s = 0;
    double peak_acceleration_mm_s2 = 0;  // of its pieces, rising or falling
    double peak_jump_mm_s = 0;           // the largest sudden change of its speed: in a corner, from and to rest
    double min_mm = 0;                   // the range of its positions, its start included
    double max_mm = 0;
};

struct ProgramPlan {
    std::string program;
    std::vector<double> start_mm;
    std::vector<LegPlan> legs;  // from rest to rest; between two of them the program waits for a person
    int moves = 0;
    int pauses = 0;
    Ticks duration;  // of all legs, dwells included; pauses are not
    double duration_s = 0;
    double length_mm = 0;  // along the path
    std::vector<AxisPlan> axes;
};

/// Plans the program as the coordinator does, from its start position.
std::expected<ProgramPlan, PlanError> plan_program(const MachineConfig& machine, const Program& program);

/// `lines`: of the G-code file.
proto::PlanReport to_report(const ProgramPlan& plan, int lines);

}  // namespace lockstep
