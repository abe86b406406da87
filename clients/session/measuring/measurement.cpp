#include <fmt/format.h>

#include <algorithm>

#include "clients/session/measuring/measure_words.hpp"
#include "clients/session/measuring/measuring_program.hpp"
#include "clients/text/format.hpp"
#include "services/documents/heights/height_file.hpp"

namespace lockstep {
namespace {

using Set = void (proto::Measurement::*)(double);

struct Result {
    std::string_view global;
    Set set;
};

std::vector<Result> results_of(const MeasureOptions& options) {
    using M = proto::Measurement;
    switch (options.kind) {
        case MeasureKind::Edge: {
            const bool along_x = one_way(options.words).value().axis == 0;
            return {{"_edge", along_x ? &M::set_x_mm : &M::set_y_mm}};
        }
        case MeasureKind::Angle: return {{"_angle", &M::set_angle_deg}};
        case MeasureKind::Corner: return {{"_corner_x", &M::set_x_mm}, {"_corner_y", &M::set_y_mm}};
        case MeasureKind::Bore:
        case MeasureKind::Boss:
            return {{"_centre_x", &M::set_x_mm},
                    {"_centre_y", &M::set_y_mm},
                    {"_diameter_x", &M::set_diameter_x_mm},
                    {"_diameter_y", &M::set_diameter_y_mm}};
        case MeasureKind::Tool: return {{"_tool_length", &M::set_tool_length_mm}};
        case MeasureKind::Surface: return {{"_lowest", &M::set_lowest_mm}, {"_highest", &M::set_highest_mm}};
    }
    return {};
}

/// Each point is touched twice, the second time slowly. Returns false if there are more or fewer touches.
bool add_points(const SurfaceGrid& grid, std::span<const double> touches_z_mm, proto::Measurement& measured) {
    if (touches_z_mm.size() != 2 * grid.x_mm.size() * grid.y_mm.size()) { return false; }
    std::size_t touch = 1;
    for (const double y_mm : grid.y_mm) {
        for (const double x_mm : grid.x_mm) {
            proto::SurfacePoint& point = *measured.add_points();
            point.set_x_mm(x_mm);
            point.set_y_mm(y_mm);
            point.set_z_mm(touches_z_mm[touch]);
            touch += 2;
        }
    }
    return true;
}

}  // namespace

std::optional<proto::Measurement> measurement_of(const MeasureOptions& options, const MeasuringProgram& program,
                                                 const std::function<std::optional<double>(std::string_view)>& global,
                                                 std::span<const double> touches_z_mm) {
    proto::Measurement measured;
    measured.set_kind(std::string(name_of(options.kind)));
    for (const Result& result : results_of(options)) {
        const auto value = global(result.global);
        if (!value) { return std::nullopt; }
        (measured.*result.set)(*value);
    }
    if (program.grid && !add_points(*program.grid, touches_z_mm, measured)) { return std::nullopt; }
    return measured;
}

std::string text_of(const proto::Measurement& measured) {
    std::vector<std::string> parts;
    std::string place;
    if (measured.has_x_mm()) { place = "X " + fixed(measured.x_mm(), 4); }
    if (measured.has_y_mm()) { place += (place.empty() ? "Y " : "  Y ") + fixed(measured.y_mm(), 4); }
    if (measured.has_diameter_x_mm()) { place = "centre " + place; }
    if (!place.empty()) { parts.push_back(place + " mm"); }
    if (measured.has_diameter_x_mm()) {
        parts.push_back(fmt::format("diameter {} mm along X, {} mm along Y", fixed(measured.diameter_x_mm(), 4),
                                    fixed(measured.diameter_y_mm(), 4)));
    }
    if (measured.has_angle_deg()) { parts.push_back(fixed(measured.angle_deg(), 4) + " degrees"); }
    if (measured.has_tool_length_mm()) { parts.push_back("length " + fixed(measured.tool_length_mm(), 4) + " mm"); }
    if (measured.has_lowest_mm()) {
        parts.push_back(fmt::format("{} points, Z {} to {} mm", measured.points_size(), fixed(measured.lowest_mm(), 4),
                                    fixed(measured.highest_mm(), 4)));
    }
    return measured.kind() + ": " + fmt::format("{}", fmt::join(parts, "; "));
}

std::string csv_of(const proto::Measurement& measured) {
    std::string text = std::string(kHeightColumns) + "\n";
    for (const proto::SurfacePoint& point : measured.points()) {
        text += fmt::format("{},{},{}\n", fixed(point.x_mm(), 6), fixed(point.y_mm(), 6), fixed(point.z_mm(), 6));
    }
    return text;
}

}  // namespace lockstep
