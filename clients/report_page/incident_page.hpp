// An incident as one self-contained HTML page: a lane for each process, the motion of the axes, all
// events.
#pragma once

#include <expected>
#include <filesystem>
#include <string>

#include "clients/analysis/analysis.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep::incident {

/// `log`: the run's log, from which the curves are drawn. If null, they are drawn from the axes' notes, ten per second.
std::string to_html(const proto::IncidentReport& report, const analysis::Analysis* log);

/// The error names the file and the reason.
std::expected<void, std::string> write_html(const proto::IncidentReport& report, const analysis::Analysis* log,
                                            const std::filesystem::path& path);

}  // namespace lockstep::incident
