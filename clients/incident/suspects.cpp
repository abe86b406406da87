#include "clients/incident/suspects.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/incident/sentences.hpp"
#include "clients/incident/silences.hpp"
#include "core/protocol/rules.hpp"

namespace lockstep::incident {
namespace {

Ticks hop(const Incident& incident) { return incident.slots(rules::kHopSlots); }

/// The longest standstill of a process around `at` that exceeds the machine's allowance.
const Entry* standstill(const Incident& incident, FlightPeer who, Tick at) {
    const Entry* longest = nullptr;
    for (const Entry& entry : incident.timeline) {
        const FlightEvent& event = entry.event;
        if (event.kind != FlightKind::Stalled || incident.processes[entry.process].who != who) { continue; }
        const bool matters = event.lasts >= incident.slots(incident.machine.timing.stall_slots);
        const bool is_then = event.tick >= at - reach(incident) && event.tick - event.lasts <= at + hop(incident);
        const bool is_longer = longest == nullptr || event.lasts > longest->event.lasts;
        if (matters && is_then && is_longer) { longest = &entry; }
    }
    return longest;
}

/// How long both processes stood still at the same time.
Ticks overlap(const Entry& a, const Entry& b) {
    const Tick from = std::max(a.tick - a.event.lasts, b.tick - b.event.lasts);
    return std::max(Ticks{}, std::min(a.tick, b.tick) - from);
}

/// Whether another process had replaced it between `ended` and `by`.
bool has_successor_since(const Incident& incident, FlightPeer who, Tick ended, Tick by) {
    return std::ranges::any_of(incident.processes, [&](const Process& process) {
        return process.who == who && process.first > ended && process.first < by;
    });
}

std::optional<Cause> explain_by_end(const Incident& incident, FlightPeer suspect, Tick at) {
    for (const Process& process : incident.processes) {
        if (process.who != suspect || !process.ended || process.last > at + hop(incident)) { continue; }
        if (has_successor_since(incident, suspect, process.last, at - reach(incident))) { continue; }
        return Cause{CauseKind::Ended, suspect, end_text(incident, process), process.last, {}};
    }
    for (const Entry& entry : incident.timeline) {
        const bool is_then = entry.tick >= at - reach(incident);
        if (!is_then || entry.event.kind != FlightKind::PeerRestarted || entry.event.about != suspect) { continue; }
        return Cause{
            CauseKind::Ended,
            suspect,
            fmt::format("the process of {} ended, and another process replaced it", peer_name(incident, suspect)),
            std::nullopt,
            {}};
    }
    return std::nullopt;
}

std::optional<Cause> explain_by_standstill(const Incident& incident, FlightPeer suspect, Tick at) {
    const Entry* stall = standstill(incident, suspect, at);
    if (stall == nullptr) { return std::nullopt; }
    const Ticks lasts = stall->event.lasts;
    const Tick from = stall->tick - lasts;
    MotorSet motors;
    std::size_t together = 0;
    std::vector<FlightPeer> looked_at;  // a process may have several lives
    for (const Process& process : incident.processes) {
        if (std::ranges::find(looked_at, process.who) != looked_at.end()) { continue; }
        looked_at.push_back(process.who);
        const Entry* other = standstill(incident, process.who, at);
        if (other == nullptr || overlap(*other, *stall) * 2 < lasts) { continue; }
        ++together;
        if (process.who.kind == FlightPeer::Kind::Axis) { motors.insert(process.who.motor()); }
    }
    if (together > 1 && 2 * together >= looked_at.size()) {
        return Cause{CauseKind::HostStalled, std::nullopt,
                     fmt::format("{} processes stalled at the same time, for up to {}, including {}; check "
                                 "their host",
                                 together, duration(incident.seconds(lasts)), axes_named(incident, motors)),
                     from, lasts};
    }
    return Cause{CauseKind::Stalled, suspect,
                 fmt::format("{} stalled: its loop did not run for {}; the machine allows {}",
                             peer_name(incident, suspect), duration(incident.seconds(lasts)),
                             duration(incident.seconds(incident.slots(incident.machine.timing.stall_slots)))),
                 from, lasts};
}

/// Blames a process if its notes were read on request and end more than freshness_slots before `at`.
std::optional<Cause> explain_by_hanging(const Incident& incident, FlightPeer suspect, Tick at) {
    const Ticks quiet = incident.slots(incident.machine.timing.freshness_slots);
    for (const Process& process : incident.processes) {
        if (process.who != suspect || !process.was_asked || process.last + quiet >= at) { continue; }
        return Cause{CauseKind::Hangs,
                     suspect,
                     fmt::format("{} stalled: its loop has not run since then; check whether its process is stopped",
                                 peer_name(incident, suspect)),
                     process.last,
                     {}};
    }
    return std::nullopt;
}

std::optional<Cause> explain_by_refusal(const Incident& incident, FlightPeer suspect, Tick at) {
    for (const Entry& entry : incident.timeline) {
        const bool is_its = incident.processes[entry.process].who == suspect;
        const bool is_then = entry.tick >= at - reach(incident) && entry.tick <= at;
        if (!is_its || !is_then || entry.event.kind != FlightKind::FrameRefused) { continue; }
        return Cause{CauseKind::Refused,
                     suspect,
                     peer_name(incident, suspect) + " " + sentence(incident, entry),
                     entry.tick,
                     {}};
    }
    return std::nullopt;
}

}  // namespace

Ticks reach(const Incident& incident) {
    const ProtocolTiming& timing = incident.machine.timing;
    return incident.slots(timing.send_ahead_slots + timing.frame_slots);
}

std::optional<Cause> explain(const Incident& incident, FlightPeer suspect, Tick at) {
    for (const auto by : {explain_by_end, explain_by_standstill, explain_by_hanging, explain_by_refusal}) {
        if (auto cause = by(incident, suspect, at)) { return cause; }
    }
    return std::nullopt;
}

std::optional<Cause> explain_by_network(const Incident& incident, Tick at) {
    const auto cut = cut_off(incident, silences(incident, at - reach(incident), at + hop(incident)));
    if (!cut) { return std::nullopt; }
    const std::string text = fmt::format("{}, for {}", cut->text, duration(incident.seconds(cut->lasts)));
    return Cause{CauseKind::CutOff, cut->who, text, cut->from, cut->lasts};
}

}  // namespace lockstep::incident
