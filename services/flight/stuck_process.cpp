#include "services/flight/stuck_process.hpp"

#include <fmt/format.h>

#include <cstdlib>

#include "services/runtime/log.hpp"
#include "services/runtime/loop_watchdog.hpp"

namespace lockstep {
namespace {

constexpr std::chrono::milliseconds kPatience{200};  // how long to wait for the log's disk

}  // namespace

void end_stuck_process(FlightLog& flight, Tick now, std::int64_t tick_ns) {
    const Ticks stood{std::chrono::nanoseconds(kLongestLoop).count() / tick_ns};
    flight.add({.tick = now + stood, .kind = FlightKind::LoopStuck, .lasts = stood});
    log_error(fmt::format(
        "the loop has not run for {} s, because a library call does not return; this process ends itself so that "
        "it is started again",
        kLongestLoop.count()));
    drain_log(kPatience);
    std::abort();
}

}  // namespace lockstep
