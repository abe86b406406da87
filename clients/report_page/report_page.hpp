// An analysis as one HTML page that needs nothing else: what was asked and made, charts to zoom into, what went wrong.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

#include "clients/analysis/analysis.hpp"

namespace lockstep::analysis {

std::string to_html(const Analysis& analysis);

/// Whether a report may be written there: nothing is there yet, or a report.
bool may_replace(const std::filesystem::path& path);

/// Why not, where it may not.
std::string in_the_way(const std::filesystem::path& path);

/// The error names the file and the reason.
std::expected<void, std::string> write_html(const Analysis& analysis, const std::filesystem::path& path);

}  // namespace lockstep::analysis
