// Writes figures as SVG files into a directory.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "clients/drawing/figure.hpp"

namespace lockstep {

/// Each figure has its file name. Creates the directory if it is missing. The error names the file and the reason.
std::expected<void, std::string> write_figures(const std::filesystem::path& directory,
                                               const std::vector<std::pair<std::string, drawing::Figure>>& figures);

}  // namespace lockstep
