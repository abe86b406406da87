// Reports a failed check of this process (core/check.hpp) in the service's log and in the flight ring. The process's
// successor writes the ring to an incident file.
#pragma once

#include "core/check.hpp"
#include "core/flight/flight_event.hpp"

namespace lockstep {

/// Reports failed checks of this process while it exists. At most one object exists in a process.
class CheckReport {
public:
    explicit CheckReport(FlightLog& flight);
    CheckReport(const CheckReport&) = delete;
    CheckReport& operator=(const CheckReport&) = delete;
    /// Restores the previous reporter.
    ~CheckReport();

private:
    CheckReporter before_;
};

}  // namespace lockstep
