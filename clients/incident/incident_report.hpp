// An incident as a report: for --json, and for the page.
#pragma once

#include "clients/incident/cause.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep::incident {

proto::IncidentReport to_report(const Incident& incident, const Evaluation& evaluation);

}  // namespace lockstep::incident
