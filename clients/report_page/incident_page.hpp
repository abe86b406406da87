// An incident as one HTML page that needs nothing else: a lane for each process, how the axes moved, all that was
// noted.
#pragma once

#include <expected>
#include <filesystem>
#include <optional>
#include <string>

#include "clients/analysis/analysis.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep::incident {

/// `log`: of the run, for the curves; null: they are drawn from what the axes noted ten times a second.
std::string to_html(const proto::IncidentReport& report, const analysis::Analysis* log);

/// The error names the file and the reason.
std::expected<void, std::string> write_html(const proto::IncidentReport& report, const analysis::Analysis* log,
                                            const std::filesystem::path& path);

}  // namespace lockstep::incident
