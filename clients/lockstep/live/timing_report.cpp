#include "clients/lockstep/live/timing_report.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "clients/doctor/probes.hpp"
#include "clients/text/format.hpp"
#include "services/documents/edit/timing_edit.hpp"

namespace lockstep {
namespace {

std::string text_of(const HoldTimes& hold) {
    return fmt::format("{} to {} ms", fixed(hold.from_ms, 0), fixed(hold.to_ms, 0));
}

}  // namespace

doctor::StallFacts watch_for_stalls(std::int64_t slot_us, double seconds, Output& output) {
    const auto period = std::chrono::microseconds(slot_us) / 4;
    const auto during = std::chrono::nanoseconds(static_cast<std::int64_t>(seconds * 1e9));
    return doctor::look_for_stalls(period, during, [&](double done) {
        output.progress(fmt::format("watching for stalls {} %", std::lround(done * 100)));
    });
}

HoldTimes hold_times(const ProtocolTiming& timing) {
    const double slot_ms = static_cast<double>(timing.slot_us) / 1000;
    return {slot_ms * timing.lease_slots(), slot_ms * (timing.lease_slots() + timing.frame_slots)};
}

proto::TimingReport timing_report(const doctor::StallFacts& facts, const ProtocolTiming& timing) {
    proto::TimingReport report;
    if (facts.seconds > 0) {
        report.set_seconds(facts.seconds);
        report.set_p99_ms(facts.p99_us / 1000);
    }
    report.set_worst_ms(facts.worst_us / 1000);
    report.set_timing(slots_text(timing));
    report.set_hold_from_ms(hold_times(timing).from_ms);
    report.set_hold_to_ms(hold_times(timing).to_ms);
    return report;
}

void print_timing(const doctor::StallFacts& facts, const ProtocolTiming& proposed, const ProtocolTiming& today,
                  Output& output) {
    if (facts.seconds > 0) {
        output.print(fmt::format("in {} s a thread woke up at most {} ms late, and in 99 of 100 cases at most {} ms",
                                 fixed(facts.seconds, 0), fixed(facts.worst_us / 1000, 2),
                                 fixed(facts.p99_us / 1000, 2)));
    }
    output.print("proposed timing, for stalls twice as long as the longest:");
    output.print("  " + slots_text(proposed));
    output.print(fmt::format("a hold begins after {}; with the machine's present timing it begins after {}",
                             text_of(hold_times(proposed)), text_of(hold_times(today))));
}

}  // namespace lockstep
