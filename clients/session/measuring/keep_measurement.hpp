// Makes the result of a measurement a value that outlives programs: the zero or the rotation of a coordinate system, or
// the length of a tool. Pure.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "clients/session/values/value_words.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// The measured axes read `reads_mm` in the coordinate system at the place that was measured; an angle becomes the
/// rotation. `start_mm`: where the axes stood when the measurement began. Errors: those of touch_off(), and a
/// measurement that has neither a place nor an angle.
Changed keep_in_system(const MachineConfig& machine, std::string_view system, const proto::Measurement& measured,
                       double reads_mm, std::vector<double> start_mm, gcode::KeptValues& values);
/// The same for the place of one touch. `moved`: the axes that the probing move moved. Fails without a touch.
Changed keep_in_system(const MachineConfig& machine, std::string_view system, const proto::ProbeReport& touch,
                       const std::vector<std::string>& moved, double reads_mm, gcode::KeptValues& values);
/// Errors: those of set_tool(), and a measurement of something else.
Changed keep_in_tool(const MachineConfig& machine, int tool, const proto::Measurement& measured,
                     gcode::KeptValues& values);

}  // namespace lockstep
