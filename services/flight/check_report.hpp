// Reports the failed check of this process (core/check.hpp) where a person finds it: in the service's log, and in the
// flight ring, from which the process that takes its place writes an incident file.
#pragma once

#include "core/check.hpp"
#include "core/flight/flight_event.hpp"

namespace lockstep {

/// While it lives, checks that fail in this process are reported. One at a time in a process.
class CheckReport {
public:
    explicit CheckReport(FlightLog& flight);
    CheckReport(const CheckReport&) = delete;
    CheckReport& operator=(const CheckReport&) = delete;
    /// The reporter before it is in place again.
    ~CheckReport();

private:
    CheckReporter before_;
};

}  // namespace lockstep
