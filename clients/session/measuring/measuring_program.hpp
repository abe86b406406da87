// Makes the programs that measure with a probe, and reads their results. Each calls a subroutine of
// deploy/subroutines. Pure.
#pragma once

#include <cstdint>
#include <expected>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/session/measuring/measure_words.hpp"
#include "core/machine.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

enum class MeasureKind : std::uint8_t { Edge, Angle, Corner, Bore, Boss, Tool, Surface };
std::string_view name_of(MeasureKind kind);

/// What a person asks for. Which values count depends on the kind.
struct MeasureOptions {
    MeasureKind kind = MeasureKind::Edge;
    std::vector<std::string> words;  // Edge, Angle, Corner: "X=10", ways from here; Surface: "X=10:190", from and to
    double feed_mm_min = 0;          // of the slow touch; the first one has five times as much
    double back_mm = 1;              // off the work between two touches
    double tip_mm = 0;               // the diameter of the ball
    std::optional<int> probe;        // its number; nullopt: the machine's only one
    double diameter_mm = 0;          // Bore, Boss: about
    double down_mm = 0;              // Boss, Tool, Surface: the farthest way down from here
    double clearance_mm = 0;         // Boss: beside it; Corner: beside the corner
    double along_mm = 0;             // Angle: from the first touch to the second
    double setter_mm = 0;            // Tool: the top of the setter in Z, without a tool
    double spacing_mm = 0;           // Surface: the greatest distance of two points in X and in Y
};

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
