// What a program will do: how long it takes, how far it goes and what it asks of each axis. Nothing moves.
#pragma once

#include <expected>
#include <string>
#include <vector>

#include "core/coordinator/path/program_plan.hpp"
#include "core/machine.hpp"
#include "core/motion/path.hpp"
#include "core/program.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// Where a homed machine stands: one place in mm per axis, each on a whole step.
std::vector<double> parked_mm(const MachineConfig& machine);

struct AxisPlan {
    std::string name;
    std::int64_t steps = 0;  // both ways together
    double peak_velocity_mm_s = 0;
    double peak_acceleration_mm_s2 = 0;  // of its phases, rising or falling
    double peak_jump_mm_s = 0;           // the most its speed changes by at once: in a corner, from and to rest
    double min_mm = 0;                   // where it goes, its start included
    double max_mm = 0;
};

struct ProgramPlan {
    std::string program;
    std::vector<double> start_mm;
    std::vector<Path> paths;  // from rest to rest; between two of them the program waits for a person
    int moves = 0;
    int pauses = 0;
    Ticks duration;  // of all paths, dwells included; pauses are not
    double duration_s = 0;
    double length_mm = 0;  // along the path
    std::vector<AxisPlan> axes;
};

/// Plans the program as the coordinator does, from where it says that it starts.
std::expected<ProgramPlan, PlanError> plan_program(const MachineConfig& machine, const Program& program);

/// `lines`: of the G-code file.
proto::PlanReport to_report(const ProgramPlan& plan, int lines);

}  // namespace lockstep
