// Makes the programs that measure with a probe, and reads their results. Each calls a subroutine of
// deploy/subroutines. Pure.
#pragma once

#include <expected>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/session/measuring/measure_options.hpp"
#include "clients/session/measuring/measure_words.hpp"
#include "core/machine.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// The points of a surface: X from x_mm[0], at each Y from y_mm[0].
struct SurfaceGrid {
    std::vector<double> x_mm;
    std::vector<double> y_mm;
};

struct MeasuringProgram {
    std::string text;  // in machine coordinates: for an interpreter without offsets
    int probe = 0;     // its number
    std::optional<SurfaceGrid> grid;
};

/// `start_mm`: where the axes stand. Errors, with the value, the limit and the remedy: the machine lacks X, Y, Z or the
/// probe; a value is missing or out of range; the axes could leave their travel; the grid has too many points.
std::expected<MeasuringProgram, MeasureError> measuring_program(const MachineConfig& machine,
                                                                const std::vector<double>& start_mm,
                                                                const MeasureOptions& options);

/// The result of a program that was run to its end. `global`: its values by their names. `touches_z_mm`:
/// the places of Z at its touches, in order. Nullopt: the program has not set its result.
std::optional<proto::Measurement> measurement_of(const MeasureOptions& options, const MeasuringProgram& program,
                                                 const std::function<std::optional<double>(std::string_view)>& global,
                                                 std::span<const double> touches_z_mm);

/// "centre X 90.3701  Y 75.8102, diameter 25.0400 in X, 25.0390 in Y"
std::string text_of(const proto::Measurement& measured);
/// The points of a surface as a table with a header: x_mm,y_mm,z_mm.
std::string csv_of(const proto::Measurement& measured);

}  // namespace lockstep
