// The timing that suits a host, measured or given: what `lockstep doctor --timing` and `lockstep timing apply` report.
#pragma once

#include "clients/doctor/ratings.hpp"
#include "clients/text/output.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// Watches this host for so long, and shows the progress. `slot_us`: the services wake four times in it.
doctor::StallFacts watch_for_stalls(std::int64_t slot_us, double seconds, Output& output);

/// When a hold begins after its command: at the earliest and at the latest, in milliseconds.
struct HoldTimes {
    double from_ms = 0;
    double to_ms = 0;
};
HoldTimes hold_times(const ProtocolTiming& timing);

proto::TimingReport timing_report(const doctor::StallFacts& facts, const ProtocolTiming& timing);
/// What was measured, the proposal, and what it means for a hold beside today's timing.
void print_timing(const doctor::StallFacts& facts, const ProtocolTiming& proposed, const ProtocolTiming& today,
                  Output& output);

}  // namespace lockstep
