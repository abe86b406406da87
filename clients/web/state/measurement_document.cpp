#include "clients/web/state/measurement_document.hpp"

#include <cmath>

#include "clients/web/state/axis_document.hpp"

namespace lockstep::web {
namespace {

using nlohmann::json;

constexpr int kMeasuredDigits = 6;

json places_json(const proto::ProbeReport& touch) {
    json places = json::object();
    for (const proto::ProbePlace& place : touch.places()) {
        places[place.name()] = rounded(place.position_mm(), kMeasuredDigits);
    }
    return places;
}

json behind_json(const proto::ProbeReport& touch) {
    double squares = 0;
    for (const proto::ProbePlace& place : touch.places()) { squares += place.behind_mm() * place.behind_mm(); }
    return rounded(std::sqrt(squares), kMeasuredDigits);
}

json result_json(const MeasureResult& result) {
    const proto::Measurement& measured = result.measured;
    const auto known = [](bool is_known, double value) {
        return is_known ? json(rounded(value, kMeasuredDigits)) : json();
    };
    return {{"touched", result.touch.touched()},
            {"input", result.touch.input().empty() ? json() : json(result.touch.input())},
            {"touch", places_json(result.touch)},
            {"behind", behind_json(result.touch)},
            {"x", known(measured.has_x_mm(), measured.x_mm())},
            {"y", known(measured.has_y_mm(), measured.y_mm())},
            {"diameter_x", known(measured.has_diameter_x_mm(), measured.diameter_x_mm())},
            {"diameter_y", known(measured.has_diameter_y_mm(), measured.diameter_y_mm())},
            {"angle_deg", known(measured.has_angle_deg(), measured.angle_deg())},
            {"tool_length", known(measured.has_tool_length_mm(), measured.tool_length_mm())},
            {"lowest", known(measured.has_lowest_mm(), measured.lowest_mm())},
            {"highest", known(measured.has_highest_mm(), measured.highest_mm())}};
}

json points_json(const MeasurePlan& plan) {
    const auto& grid = plan.program.grid;
    return grid ? json(grid->x_mm.size() * grid->y_mm.size()) : json();
}

}  // namespace

json measurement_document(const Measurement& measurement) {
    return {{"number", measurement.number},
            {"kind", measurement.plan->kind()},
            {"touches", measurement.touches},
            {"points", points_json(*measurement.plan)},
            {"result", measurement.result ? result_json(*measurement.result) : json()},
            {"problem", measurement.problem ? problem_json(*measurement.problem) : json()}};
}

}  // namespace lockstep::web
