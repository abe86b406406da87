// What a person asks to be measured with a probe.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

}  // namespace lockstep
