#include "clients/incident/incident_report.hpp"

#include "clients/incident/notes.hpp"
#include "clients/incident/sentences.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep::incident {
namespace {

std::string name_of_weight(Weight weight) {
    return weight == Weight::Telling ? "telling" : weight == Weight::Notable ? "notable" : "routine";
}

void add(const Incident& incident, const Process& process, Tick zero, proto::IncidentReport& report) {
    proto::IncidentProcess& out = *report.add_processes();
    out.set_name(process.name);
    out.set_ended(process.ended);
    out.set_first_s(incident.seconds(process.first - zero));
    out.set_last_s(incident.seconds(process.last - zero));
    out.set_clock_error_us(incident.machine.microseconds(process.clock_error));
    for (const std::string& file : process.files) { out.add_files(file); }
}

void add(const Incident& incident, const Entry& entry, Tick zero, proto::IncidentReport& report) {
    const FlightEvent& event = entry.event;
    proto::IncidentEvent& out = *report.add_events();
    out.set_at_s(incident.seconds(entry.tick - zero));
    out.set_tick(entry.tick.value);
    out.set_process(incident.processes[entry.process].name);
    out.set_what(std::string(lockstep::name_of(event.kind)));
    out.set_text(sentence(incident, entry));
    out.set_weight(name_of_weight(weight_of(incident, entry)));
    if (event.about != FlightPeer{}) { out.set_about(peer_name(incident, event.about)); }
    if (event.fault != FaultCode::None) { out.set_fault(std::string(lockstep::name_of(event.fault))); }
    if (event.frame != 0) { out.set_frame(event.frame); }
    if (event.lasts != Ticks{}) { out.set_lasts_s(incident.seconds(event.lasts)); }
    const FlightPeer who = incident.processes[entry.process].who;
    const bool is_place = event.kind == FlightKind::State || event.kind == FlightKind::Phase;
    if (!is_place || who.kind != FlightPeer::Kind::Axis) { return; }
    const double steps_per_mm = motor_steps_per_mm(incident.machine, who.motor());
    out.set_position_mm(static_cast<double>(event.count) / steps_per_mm);
    out.set_velocity_mm_s(event.amount / steps_per_mm);
}

}  // namespace

proto::IncidentReport to_report(const Incident& incident, const Evaluation& evaluation) {
    proto::IncidentReport report;
    report.set_machine(incident.machine.name);
    report.set_written(wall_time(incident.wall_us));
    report.set_cause(std::string(name_of(evaluation.cause.kind)));
    if (evaluation.cause.who) { report.set_culprit(peer_name(incident, *evaluation.cause.who)); }
    if (evaluation.cause.at) { report.set_cause_at_s(incident.seconds(*evaluation.cause.at - evaluation.noticed)); }
    if (evaluation.cause.lasts > Ticks{}) { report.set_cause_lasts_s(incident.seconds(evaluation.cause.lasts)); }
    if (evaluation.rest) { report.set_rest_s(incident.seconds(*evaluation.rest - evaluation.noticed)); }
    for (const MotorIndex motor : evaluation.moving) { report.add_moving(motor_name(incident.machine, motor)); }
    report.set_noticed_tick(evaluation.noticed.value);
    for (const std::string& sentence : evaluation.story) { report.add_story(sentence); }
    for (const Process& process : incident.processes) { add(incident, process, evaluation.noticed, report); }
    for (const Entry& entry : incident.timeline) { add(incident, entry, evaluation.noticed, report); }
    for (const std::string& note : notes_of(incident)) { report.add_notes(note); }
    return report;
}

void add_summaries(const std::vector<Incident>& incidents, proto::IncidentReport& report) {
    for (std::size_t back = 0; back < incidents.size(); ++back) {
        const Incident& incident = incidents[incidents.size() - 1 - back];
        const Evaluation evaluation = evaluate(incident);
        proto::IncidentSummary& summary = *report.add_incidents();
        summary.set_back(static_cast<std::int64_t>(back));
        summary.set_written(wall_time(incident.wall_us));
        summary.set_cause(std::string(name_of(evaluation.cause.kind)));
        const auto& story = evaluation.story;
        summary.set_text(story.size() < 2 ? story.front() : story.front() + "; " + story.back());
    }
}

}  // namespace lockstep::incident
