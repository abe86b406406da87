#include "clients/web/measuring/measurement.hpp"

#include "clients/session/control/probe_touch.hpp"
#include "clients/session/measuring/keep_measurement.hpp"
#include "clients/web/request/body_reader.hpp"

namespace lockstep::web {
namespace {

/// The axes that a probing move names.
std::vector<std::string> moved_axes(const ProbeOptions& options) {
    std::vector<std::string> axes;
    for (const std::string& word : options.move.targets) { axes.push_back(word.substr(0, word.find('='))); }
    return axes;
}

Problem no_result() {
    return {.status = 409,
            .code = "no-result",
            .title = "the measurement ended without a result",
            .detail = "the program of the measurement came to its end without its result",
            .remedy = "read the messages of the job, and measure again"};
}

}  // namespace

std::string MeasurePlan::kind() const { return options() != nullptr ? std::string(name_of(options()->kind)) : "touch"; }

std::expected<MeasureResult, Problem> measure_result(
    const MachineConfig& machine, const MeasurePlan& plan, std::span<const ProbeTouch> touches,
    const std::function<std::optional<double>(std::string_view)>& global) {
    if (touches.empty()) { return std::unexpected(no_result()); }
    MeasureResult result{.touch = probe_report(machine, touches.back()), .measured = {}};
    const MeasureOptions* options = plan.options();
    if (options == nullptr) {
        result.measured.set_kind(plan.kind());
        return result;
    }
    std::vector<double> places_z_mm;
    const AxisIndex z = find_axis(machine, "Z").value();
    for (const ProbeTouch& touch : touches) { places_z_mm.push_back(touch.places_mm[z]); }
    auto measured = measurement_of(*options, plan.program, global, places_z_mm);
    if (!measured) { return std::unexpected(no_result()); }
    result.measured = *std::move(measured);
    return result;
}

std::expected<gcode::KeptValues, Problem> kept(const KeepOrder& order, const MachineConfig& machine,
                                               const std::optional<Measurement>& measurement,
                                               gcode::KeptValues values) {
    if (!measurement || !measurement->result) { return std::unexpected(nothing_measured("a result")); }
    const MeasureResult& result = *measurement->result;
    const MeasurePlan& plan = *measurement->plan;
    const auto* touch = std::get_if<ProbeOptions>(&plan.order.what);
    const Changed changed =
        order.tool ? keep_in_tool(machine, *order.tool, result.measured, values)
        : touch != nullptr
            ? keep_in_system(machine, order.system, result.touch, moved_axes(*touch), order.reads_mm, values)
            : keep_in_system(machine, order.system, result.measured, order.reads_mm, plan.start_mm, values);
    if (!changed) {
        return std::unexpected(wrong_value(422, order.tool ? "/tool" : "/system",
                                           order.tool ? Json(*order.tool) : Json(order.system), changed.error()));
    }
    return values;
}

Problem nothing_measured(const std::string& what) {
    return {.status = 409,
            .code = "no-measurement",
            .title = "nothing is measured",
            .detail = "there is no measurement with " + what,
            .remedy = "measure with a probe first"};
}

}  // namespace lockstep::web
