// An analysis as one self-contained HTML page: commanded and made motion, charts to zoom into, errors.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

#include "clients/analysis/analysis.hpp"

namespace lockstep::analysis {

std::string to_html(const Analysis& analysis);

/// Returns true if a report may be written there: the path does not exist, or is a report.
bool may_replace(const std::filesystem::path& path);

/// The message for a path that may not be replaced.
std::string in_the_way(const std::filesystem::path& path);

/// The error names the file and the reason.
std::expected<void, std::string> write_html(const Analysis& analysis, const std::filesystem::path& path);

}  // namespace lockstep::analysis
