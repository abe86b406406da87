// The timing for the measured or given stalls of a host, as `lockstep doctor --timing` and `lockstep timing apply`
// report it.
#pragma once

#include "clients/doctor/ratings.hpp"
#include "clients/text/output.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// Measures the stalls of this host for `seconds`, and shows the progress. Wakes four times per slot, as the services
/// do.
doctor::StallFacts watch_for_stalls(std::int64_t slot_us, double seconds, Output& output);

/// The earliest and the latest beginning of a hold after its command, in milliseconds.
struct HoldTimes {
    double from_ms = 0;
    double to_ms = 0;
};
HoldTimes hold_times(const ProtocolTiming& timing);

proto::TimingReport timing_report(const doctor::StallFacts& facts, const ProtocolTiming& timing);
/// Prints the measurement, the proposed timing, and when a hold begins with it and with today's timing.
void print_timing(const doctor::StallFacts& facts, const ProtocolTiming& proposed, const ProtocolTiming& today,
                  Output& output);

}  // namespace lockstep
