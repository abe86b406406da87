// Figures as SVG files in a directory.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "clients/drawing/figure.hpp"

namespace lockstep {

/// By file name. Creates the directory if it is missing. Error: which file cannot be written, and why.
std::expected<void, std::string> write_figures(const std::filesystem::path& directory,
                                               const std::vector<std::pair<std::string, drawing::Figure>>& figures);

}  // namespace lockstep
