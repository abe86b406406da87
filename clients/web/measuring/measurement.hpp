// A measurement with a probe that this server runs: what was asked for, how far it is, and its result. Pure.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/session/measuring/measuring_program.hpp"
#include "clients/web/request/measure_order.hpp"
#include "clients/web/request/problem.hpp"
#include "core/gcode/gcode.hpp"
#include "core/gcode/kept_values.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep::web {

/// A measurement as it was asked for, from its command to its result.
struct MeasurePlan {
    MeasureOrder order;
    MeasuringProgram program;      // of several touches; of one touch only its probe counts
    std::vector<double> start_mm;  // where the axes stood

    /// touch, or a MeasureKind.
    std::string kind() const;
    /// nullptr for one touch.
    const MeasureOptions* options() const { return std::get_if<MeasureOptions>(&order.what); }
};

struct MeasureResult {
    proto::ProbeReport touch;     // the last one
    proto::Measurement measured;  // of one touch only its kind
};

/// The newest measurement. It runs until it has a result or a problem.
struct Measurement {
    std::uint64_t number = 0;  // rises
    std::shared_ptr<const MeasurePlan> plan;
    std::size_t touches = 0;  // so far
    std::shared_ptr<const MeasureResult> result;
    std::optional<Problem> problem;  // why it has no result
};

/// The result of a program that was run to its end. `global`: the value of a parameter of the program, by its name.
std::expected<MeasureResult, Problem> measure_result(
    const MachineConfig& machine, const MeasurePlan& plan, std::span<const ProbeTouch> touches,
    const std::function<std::optional<double>(std::string_view)>& global);

/// The values with the measurement in them. Fails with 409 if there is none, and with 422 if it has nothing to keep
/// there.
std::expected<gcode::KeptValues, Problem> kept(const KeepOrder& order, const MachineConfig& machine,
                                               const std::optional<Measurement>& measurement, gcode::KeptValues values);

/// 409: there is no measurement that has a result of this kind.
Problem nothing_measured(const std::string& what);

}  // namespace lockstep::web
