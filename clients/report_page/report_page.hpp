// An analysis as one self-contained HTML page: commanded and made motion, charts to zoom into, errors.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

#include "clients/analysis/analysis.hpp"

namespace lockstep::analysis {

std::string to_html(const Analysis& analysis);

/// Whether a report may be written there: the path is free, or a report.
bool may_replace(const std::filesystem::path& path);

/// The reason why it may not.
std::string in_the_way(const std::filesystem::path& path);

/// The error names the file and the reason.
std::expected<void, std::string> write_html(const Analysis& analysis, const std::filesystem::path& path);

}  // namespace lockstep::analysis
