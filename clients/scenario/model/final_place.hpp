// Where an axis ended, by the last steps of its motors.
#pragma once

#include <expected>
#include <string>

#include "core/kinematics/kinematics.hpp"
#include "core/machine.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep::scenario {

struct FinalPlace {
    double mm = 0;
    Tick last;                  // the last step of its motors
    std::int64_t off_rest = 0;  // steps of the axis by which the motors may differ from the axis's place
};

/// The error says what is not on record, or which motor is not where the others place it.
std::expected<FinalPlace, std::string> final_place(const proto::AnalysisReport& analysis, const MachineConfig& machine,
                                                   AxisIndex axis);

}  // namespace lockstep::scenario
