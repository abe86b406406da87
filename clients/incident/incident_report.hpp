// An incident as a report: for --json, and for the page.
#pragma once

#include "clients/incident/cause.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep::incident {

proto::IncidentReport to_report(const Incident& incident, const Evaluation& evaluation);

/// `incidents`: all of the same files, the oldest first.
void add_summaries(const std::vector<Incident>& incidents, proto::IncidentReport& report);

}  // namespace lockstep::incident
