#include "clients/incident/cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

#include "clients/incident/rest.hpp"
#include "clients/incident/sentences.hpp"
#include "clients/incident/suspects.hpp"
#include "core/enumeration.hpp"

namespace lockstep::incident {
namespace {

/// Whether the event shows that something is wrong.
bool is_symptom(const FlightEvent& event) {
    switch (event.kind) {
        case FlightKind::Vetoed: return static_cast<VetoReason>(event.detail) != VetoReason::Own;
        case FlightKind::Fault:
        case FlightKind::PeerFault:
        case FlightKind::FrameRefused:
        case FlightKind::PulsesStopped:
        case FlightKind::PeerRestarted: return true;
        case FlightKind::Incident: {
            const auto reason = static_cast<IncidentReason>(event.detail);
            return reason != IncidentReason::Asked && reason != IncidentReason::Ended;
        }
        default: return false;
    }
}

/// Whether the event reports an absent process, which may return without harm.
bool may_heal(const FlightEvent& event) {
    if (event.kind == FlightKind::PeerRestarted) { return true; }
    const auto reason = static_cast<IncidentReason>(event.detail);
    return event.kind == FlightKind::Incident &&
           (reason == IncidentReason::AxisLost || reason == IncidentReason::OwnerLost);
}

/// Whether the absent process had returned before `by`.
bool has_healed(const Incident& incident, const Entry& symptom, Tick by) {
    if (symptom.event.kind == FlightKind::PeerRestarted) { return symptom.tick < by; }
    return std::ranges::any_of(incident.timeline, [&](const Entry& entry) {
        const FlightKind kind = entry.event.kind;
        const bool is_back =
            kind == FlightKind::PeerReceived || kind == FlightKind::PeerRestarted || kind == FlightKind::AxisSeen;
        return is_back && entry.event.about == symptom.event.about && entry.tick >= symptom.tick && entry.tick < by;
    });
}

bool is_of_coordinator(const Incident& incident, const Entry& entry, FlightKind kind) {
    return entry.event.kind == kind && incident.processes[entry.process].who == kFlightCoordinator;
}

/// The timeline from the beginning of the epoch in which the coordinator noted a fault, because the machine continued
/// after all earlier events. The whole timeline if the coordinator noted no fault.
std::span<const Entry> since_it_went_on(const Incident& incident) {
    const std::span<const Entry> all = incident.timeline;
    const auto is_fault = [&](const Entry& entry) { return is_of_coordinator(incident, entry, FlightKind::Fault); };
    const auto fault = std::ranges::find_if(all, is_fault);
    if (fault == all.end()) { return all; }
    auto begun = fault;
    while (begun != all.begin() && !is_of_coordinator(incident, *begun, FlightKind::EpochBegun)) { --begun; }
    return {begun, all.end()};
}

/// The first symptom. Skips an absence if the process returned more than reach() before the first grave symptom.
const Entry* first_symptom(const Incident& incident) {
    const auto entries = since_it_went_on(incident);
    const auto grave =
        std::ranges::find_if(entries, [](const Entry& e) { return is_symptom(e.event) && !may_heal(e.event); });
    const bool has_grave = grave != entries.end();
    const auto counts = [&](const Entry& entry) {
        if (!is_symptom(entry.event)) { return false; }
        return !has_grave || !may_heal(entry.event) || !has_healed(incident, entry, grave->tick - reach(incident));
    };
    const auto found = std::ranges::find_if(entries, counts);
    return found == entries.end() ? nullptr : &*found;
}

/// The processes that may have caused the symptom. If the symptom names none, the process that noted it.
std::vector<FlightPeer> suspects_of(const Incident& incident, const Entry& symptom) {
    const FlightEvent& event = symptom.event;
    const FlightPeer self = incident.processes[symptom.process].who;
    if (event.kind != FlightKind::Vetoed) { return {event.about == FlightPeer{} ? self : event.about}; }
    switch (static_cast<VetoReason>(event.detail)) {
        case VetoReason::TooLate:
        case VetoReason::Own: return {self};
        case VetoReason::NotHeld: return {kFlightCoordinator, self};
        case VetoReason::NoCoordinator: return {kFlightCoordinator};
        case VetoReason::NoEvidence: break;
    }
    std::vector<FlightPeer> lacking;
    for (const MotorIndex motor : MotorSet::of_bits(static_cast<std::uint64_t>(event.count))) {
        lacking.push_back(flight_axis(motor));
    }
    return lacking;
}

/// A fault that an axis or the machine notices in itself is its own cause, unless a missing peer can cause the fault.
bool is_own_fault(const FlightEvent& event) {
    const bool is_fault = event.kind == FlightKind::Fault || event.kind == FlightKind::PeerFault;
    return is_fault && event.fault != FaultCode::AxisLost && event.fault != FaultCode::FramesDiffer &&
           event.fault != FaultCode::FrameLate && event.fault != FaultCode::PositionMismatch;
}

bool is_emergency(const FlightEvent& event) {
    return event.kind == FlightKind::PulsesStopped || event.fault == FaultCode::EmergencyStopped;
}

Cause own_fault(const Incident& incident, const Entry& symptom) {
    const FlightEvent& event = symptom.event;
    const FlightPeer who = suspects_of(incident, symptom).front();
    if (is_emergency(event)) {
        return {CauseKind::EmergencyStop, std::nullopt, "an emergency stop was commanded", symptom.tick, {}};
    }
    const FaultText* text = find_fault(event.fault);
    return {CauseKind::Fault,
            who,
            fmt::format("{}: {}; {}", peer_name(incident, who), lockstep::name_of(event.fault),
                        text == nullptr ? "" : text->cause),
            symptom.tick,
            {}};
}

std::string who_left_nothing(const Incident& incident, const std::vector<FlightPeer>& suspects) {
    std::string text;
    for (const FlightPeer who : suspects) {
        const bool has_file = std::ranges::count(incident.processes, who, &Process::who) > 0;
        if (!has_file) { text += (text.empty() ? "" : " and ") + peer_name(incident, who); }
    }
    return text;
}

Cause unknown(const Incident& incident, const Entry& symptom) {
    const std::string left_nothing = who_left_nothing(incident, suspects_of(incident, symptom));
    const std::string why = left_nothing.empty()
                                ? "none of the files shows why"
                                : left_nothing +
                                      " left no file here; lockstep flight on its host reads its notes, "
                                      "even if its process is stopped or has ended";
    return {CauseKind::Unknown, std::nullopt, why, std::nullopt, {}};
}

Cause cause_of(const Incident& incident, const Entry& symptom) {
    if (is_own_fault(symptom.event) || is_emergency(symptom.event)) { return own_fault(incident, symptom); }
    for (const FlightPeer suspect : suspects_of(incident, symptom)) {
        if (auto cause = explain(incident, suspect, symptom.tick)) { return *cause; }
    }
    if (auto cause = explain_by_network(incident, symptom.tick)) { return *cause; }
    if (symptom.event.kind == FlightKind::Fault) { return own_fault(incident, symptom); }
    return unknown(incident, symptom);
}

/// The cause of an incident without symptoms: a process ended, or nothing was wrong.
Cause cause_without_symptom(const Incident& incident) {
    for (const Process& process : incident.processes) {
        if (process.ended) { return {CauseKind::Ended, process.who, end_text(incident, process), process.last, {}}; }
    }
    return {CauseKind::Asked, std::nullopt, "nothing was wrong; the notes were requested", std::nullopt, {}};
}

std::string noticed_text(const Incident& incident, const Entry& symptom, const Cause& cause) {
    std::string text = incident.processes[symptom.process].name + " " + sentence(incident, symptom);
    if (symptom.event.kind == FlightKind::Incident) {
        const auto name = lockstep::name_of(static_cast<IncidentReason>(symptom.event.detail));
        text = fmt::format("{} noticed it ({})", incident.processes[symptom.process].name, name);
    }
    if (!cause.at || *cause.at >= symptom.tick) { return text; }
    return text + ", " + duration(incident.seconds(symptom.tick - *cause.at)) + " later";
}

std::string end_of_motion(const Incident& incident, const Rest& rest, Tick noticed) {
    if (!rest.without_rest.empty()) {
        return "the notes do not show when " + axes_named(incident, rest.without_rest) + " came to rest";
    }
    const Ticks after = *rest.at - noticed;
    if (after < Ticks{}) { return "all axes had come to rest " + duration(-incident.seconds(after)) + " before that"; }
    return "all axes at rest " + duration(incident.seconds(after)) + " after that";
}

std::string rest_text(const Incident& incident, const Rest& rest, Tick noticed) {
    if (!rest.at && rest.moving.empty()) { return "no axis was moving"; }
    const std::string end = end_of_motion(incident, rest, noticed);
    if (rest.moving.empty()) { return end; }
    const bool is_one = rest.moving.size() == 1;
    return axes_named(incident, rest.moving) + (is_one ? " was moving; " : " were moving; ") + end;
}

}  // namespace

std::string_view name_of(CauseKind kind) {
    return pick_name({"process-ended", "process-stalled", "process-hangs", "host-stalled", "cut-off", "fault",
                      "frame-refused", "emergency-stop", "asked", "unknown"},
                     kind);
}

Evaluation evaluate(const Incident& incident) {
    const Entry* symptom = first_symptom(incident);
    if (symptom == nullptr) {
        Evaluation evaluation{.cause = cause_without_symptom(incident), .noticed = {}, .rest = {}, .story = {}};
        const Tick last = incident.timeline.empty() ? Tick{} : incident.timeline.back().tick;
        evaluation.noticed = evaluation.cause.at.value_or(last);
        evaluation.story = {evaluation.cause.text};
        return evaluation;
    }
    const Tick noticed = symptom->tick;
    Cause cause = cause_of(incident, *symptom);
    const Rest rest = rest_of(incident, std::min(noticed, cause.at.value_or(noticed)));
    Evaluation evaluation{
        .cause = std::move(cause), .noticed = noticed, .rest = rest.at, .moving = rest.moving, .story = {}};
    evaluation.story = {evaluation.cause.text, noticed_text(incident, *symptom, evaluation.cause),
                        rest_text(incident, rest, noticed)};
    return evaluation;
}

}  // namespace lockstep::incident
