// Figures as SVG files in a directory.
#pragma once

#include <expected>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "clients/drawing/figure.hpp"

namespace lockstep {

/// By file name. The directory is made where it is missing. Error: what cannot be written, and why.
std::expected<void, std::string> write_figures(const std::filesystem::path& directory,
                                               const std::vector<std::pair<std::string, drawing::Figure>>& figures);

}  // namespace lockstep
