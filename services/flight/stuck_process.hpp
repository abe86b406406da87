// The end of a process whose loop stands still (services/runtime/loop_watchdog.hpp).
#pragma once

#include "core/flight/flight_event.hpp"
#include "services/flight/flight_source.hpp"

namespace lockstep {

/// Writes why to the flight record and the log, and ends the process by SIGABRT. now: when the loop last ran.
[[noreturn]] void end_stuck_process(FlightLog& flight, Tick now, std::int64_t tick_ns);

}  // namespace lockstep
