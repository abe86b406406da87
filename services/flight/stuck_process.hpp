// Ends a process with a stuck loop (services/runtime/loop_watchdog.hpp).
#pragma once

#include "core/flight/flight_event.hpp"
#include "services/flight/flight_source.hpp"

namespace lockstep {

/// Writes the reason to the flight record and the log, and ends the process by SIGABRT. `now` is when the loop last
/// ran.
[[noreturn]] void end_stuck_process(FlightLog& flight, Tick now, std::int64_t tick_ns);

}  // namespace lockstep
