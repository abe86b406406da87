// Reads the heights of a surface from a table with the columns x_mm, y_mm and z_mm, as `lockstep probe surface` writes
// it.
#pragma once

#include <expected>
#include <filesystem>
#include <string_view>

#include "core/gcode/curves/height_map.hpp"
#include "services/files/diagnostic.hpp"

namespace lockstep {

/// The first line of such a table. It may be missing.
inline constexpr std::string_view kHeightColumns = "x_mm,y_mm,z_mm";

/// Errors: the place of a line that is not three numbers; those of HeightMap::make.
std::expected<HeightMap, Diagnostics> parse_height_map(std::string_view text);
/// The same for a file. Errors also: why it cannot be read.
std::expected<HeightMap, Diagnostics> load_height_map(const std::filesystem::path& path);

}  // namespace lockstep
