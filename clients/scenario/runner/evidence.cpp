#include "clients/scenario/runner/evidence.hpp"

#include "clients/analysis/analysis.hpp"
#include "clients/analysis/report.hpp"
#include "clients/incident/cause.hpp"
#include "clients/incident/incident_input.hpp"
#include "clients/merge/named_logs.hpp"
#include "clients/merge/report.hpp"
#include "clients/scenario/model/evaluation.hpp"
#include "clients/verification/verification.hpp"
#include "core/kinematics/motors.hpp"
#include "services/files/directories.hpp"
#include "services/flight/incident_file.hpp"
#include "services/record/new_log_file.hpp"

namespace lockstep::scenario {
namespace {

namespace fs = std::filesystem;

std::expected<proto::MergeReport, std::string> merge_logs(const MachineSetup& machine, const fs::path& folder) {
    const auto logs = merge::named_logs({folder / "run.lcm", record_directory(machine.name)});
    if (!logs) { return std::unexpected(logs.error()); }
    const auto all = merge::choose_logs(*logs, true);
    if (!all) { return std::unexpected(all.error()); }
    auto out = NewLogFile::begin(folder / kWholeLog, true);
    if (!out) { return std::unexpected(out.error()); }
    const auto merged = merge::merge_logs({.logs = all->logs}, out->sink());
    if (!merged) { return std::unexpected(merged.error()); }
    if (const auto kept = out->keep(); !kept) { return std::unexpected(kept.error()); }
    return merge::to_report(*merged, folder / kWholeLog);
}

std::string name_of_peer(const incident::Incident& incident, const FlightPeer& peer) {
    if (peer.kind == FlightPeer::Kind::None) { return ""; }
    return peer.kind == FlightPeer::Kind::Axis ? "axis-" + motor_name(incident.machine, peer.motor()) : "coordinator";
}

/// Ignores vetoes for an axis's own fault or stop.
bool lacks_something(const FlightEvent& event) {
    return event.kind == FlightKind::Vetoed && event.detail != static_cast<std::uint8_t>(VetoReason::Own);
}

void read_incident_files(const MachineSetup& machine, Evidence& evidence) {
    const auto input = read_incidents({incident_directory(machine)});
    if (!input) { return; }  // no process wrote one
    for (const incident::Incident& incident : input->incidents) {
        const incident::Cause cause = incident::evaluate(incident).cause;
        evidence.causes.push_back(
            {std::string(name_of(cause.kind)), cause.who ? name_of_peer(incident, *cause.who) : "", cause.text});
        for (const incident::Entry& entry : incident.timeline) {
            const FlightPeer& who = incident.processes[entry.process].who;
            if (lacks_something(entry.event) && who.kind == FlightPeer::Kind::Axis) {
                evidence.vetoed_by.insert(motor_name(incident.machine, who.motor()));
            }
        }
    }
}

}  // namespace

Evidence read_evidence(const MachineSetup& machine, const fs::path& folder) {
    Evidence evidence;
    evidence.merged = merge_logs(machine, folder);
    const fs::path whole = folder / kWholeLog;
    if (const auto found = verification::verify_log(whole)) {
        evidence.verified = verification::to_report(*found);
    } else {
        evidence.verified = std::unexpected(found.error());
    }
    if (const auto found = analysis::analyze_log(whole, {.curves = false})) {
        evidence.analysis = analysis::to_report(*found);
    } else {
        evidence.analysis = std::unexpected(found.error());
    }
    if (auto facts = record_facts(whole)) { evidence.record = *std::move(facts); }
    read_incident_files(machine, evidence);
    return evidence;
}

}  // namespace lockstep::scenario
