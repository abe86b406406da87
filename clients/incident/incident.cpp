#include "clients/incident/incident.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

namespace lockstep::incident {
namespace {

constexpr double kApart_s = 10;                              // of machine time between two incidents
constexpr std::int64_t kApart_us = 24LL * 3600 * 1'000'000;  // of wall time: machine time restarted between the marks

using Group = std::vector<const FlightFile*>;

bool is_near(const FlightFile& a, const FlightFile& b) {
    const double ticks = static_cast<double>(std::abs((a.head.mark.tick - b.head.mark.tick).value));
    return ticks <= kApart_s * a.machine.ticks_per_second() &&
           std::abs(a.head.mark.wall_us - b.head.mark.wall_us) <= kApart_us;
}

std::vector<Group> grouped(const std::vector<FlightFile>& files) {
    Group all;
    for (const FlightFile& file : files) { all.push_back(&file); }
    std::ranges::sort(all, {}, [](const FlightFile* file) { return file->head.mark.tick; });
    std::vector<Group> groups;
    for (const FlightFile* file : all) {
        const auto found = std::ranges::find_if(groups, [&](const Group& g) { return is_near(*g.back(), *file); });
        if (found == groups.end()) {
            groups.push_back({file});
        } else {
            found->push_back(file);
        }
    }
    std::ranges::sort(groups, {}, [](const Group& group) { return group.front()->head.mark.wall_us; });
    return groups;
}

/// The axis with this process; any other process is a coordinator.
FlightPeer who_is(const MachineConfig& machine, const std::string& process) {
    for (std::size_t i = 0; i < machine.axes.size(); ++i) {
        if (process == flight_process(machine.axes[i].name)) { return flight_axis(i); }
    }
    return kFlightCoordinator;
}

int order_of(FlightPeer who) { return who.kind == FlightPeer::Kind::Coordinator ? -1 : who.axis; }

std::string name_of(const MachineConfig& machine, FlightPeer who) {
    return who.kind == FlightPeer::Kind::Coordinator ? "coordinator" : "axis " + machine.axes[who.axis].name;
}

/// All notes of one life of a process, from any number of files.
struct Life {
    FlightPeer who;
    std::map<std::uint64_t, FlightEvent> events;  // by number
    bool ended = false;
    std::string note;
    bool was_asked = false;
    std::vector<std::string> files;
};

std::vector<Life> lives_of(const Group& group) {
    std::map<std::tuple<int, Identity>, Life> lives;
    for (const FlightFile* file : group) {
        const FlightPeer who = who_is(file->machine, file->head.source.process);
        Life& life = lives[{order_of(who), file->head.source.incarnation}];
        life.who = who;
        life.ended |= file->head.mark.reason == IncidentReason::Ended;
        if (!file->note.empty()) { life.note = file->note; }
        life.was_asked |= file->head.mark.reason == IncidentReason::Asked;
        life.files.push_back(file->path.string());
        for (const NumberedEvent& noted : file->events) { life.events.emplace(noted.number, noted.event); }
    }
    std::vector<Life> out;
    for (auto& [key, life] : lives) { out.push_back(std::move(life)); }
    return out;
}

void add(const Life& life, Incident& incident) {
    Process process{.name = name_of(incident.machine, life.who),
                    .who = life.who,
                    .ended = life.ended,
                    .note = life.note,
                    .was_asked = life.was_asked,
                    .files = life.files};
    const auto before = std::ranges::count(incident.processes, life.who, &Process::who);
    if (before > 0 && life.who.kind == FlightPeer::Kind::Axis) { process.name += ", restarted"; }
    if (before > 0 && life.who.kind == FlightPeer::Kind::Coordinator) {
        process.name += fmt::format(" ({})", before + 1);
    }
    for (const auto& [number, event] : life.events) {
        if (process.first == Tick{} || event.tick < process.first) { process.first = event.tick; }
        process.last = std::max(process.last, event.tick);
        const bool is_state = event.kind == FlightKind::State || event.kind == FlightKind::Phase;
        if (is_state) { process.clock_error = std::max(process.clock_error, event.lasts); }
        incident.timeline.push_back({event.tick, incident.processes.size(), event});
    }
    if (life.ended && !life.events.empty()) {
        const FlightEvent end{.tick = process.last,
                              .kind = FlightKind::Incident,
                              .detail = static_cast<std::uint8_t>(IncidentReason::Ended)};
        incident.timeline.push_back({process.last, incident.processes.size(), end});
    }
    incident.processes.push_back(std::move(process));
}

void name_the_absent(Incident& incident) {
    const auto lacks = [&](FlightPeer who) {
        return std::ranges::find(incident.processes, who, &Process::who) == incident.processes.end();
    };
    if (lacks(kFlightCoordinator)) { incident.absent.push_back("coordinator"); }
    for (std::size_t i = 0; i < incident.machine.axes.size(); ++i) {
        if (lacks(flight_axis(i))) { incident.absent.push_back(name_of(incident.machine, flight_axis(i))); }
    }
}

Incident merged(const Group& group) {
    Incident incident{.machine = group.front()->machine, .wall_us = group.front()->head.mark.wall_us};
    for (const Life& life : lives_of(group)) { add(life, incident); }
    std::ranges::stable_sort(incident.timeline, {}, &Entry::tick);
    for (const FlightFile* file : group) {
        incident.wall_us = std::min(incident.wall_us, file->head.mark.wall_us);
        for (const analysis::Damage& damage : file->damages) {
            incident.unread.push_back(file->path.string() + ": " + analysis::damage_sentence(damage));
        }
    }
    name_the_absent(incident);
    return incident;
}

}  // namespace

std::vector<Incident> incidents_of(const std::vector<FlightFile>& files) {
    std::vector<Incident> incidents;
    for (const Group& group : grouped(files)) { incidents.push_back(merged(group)); }
    return incidents;
}

}  // namespace lockstep::incident
