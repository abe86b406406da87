// Converts an analysis to the report that `lockstep analyze --json` prints.
#pragma once

#include "clients/analysis/analysis.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep::analysis {

proto::AnalysisReport to_report(const Analysis& analysis);
void fill_unread(const Damage& damage, proto::UnreadStretch& report);

}  // namespace lockstep::analysis
