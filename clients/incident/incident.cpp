#include "clients/incident/incident.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>

#include "clients/incident/file_groups.hpp"
#include "clients/incident/separation.hpp"
#include "core/kinematics/kinematics.hpp"

namespace lockstep::incident {
namespace {

/// The axis with this process; any other process is a coordinator.
FlightPeer who_is(const MachineConfig& machine, const std::string& process) {
    for (const MotorIndex i : motor_indices(motor_count(machine))) {
        if (process == flight_process(motor_name(machine, i))) { return flight_axis(i); }
    }
    return kFlightCoordinator;
}

int order_of(FlightPeer who) { return who.kind == FlightPeer::Kind::Coordinator ? -1 : who.axis; }

std::string name_of(const Incident& incident, FlightPeer who) {
    return who.kind == FlightPeer::Kind::Coordinator ? "coordinator" : incident.motors[who.axis];
}

/// A stretch of machine time: from `from`, before `to`.
struct Window {
    Tick from;
    Tick to;
    bool has(Tick tick) const { return from <= tick && tick < to; }
};
constexpr Window kAllTime{Tick{std::numeric_limits<std::int64_t>::min()},
                          Tick{std::numeric_limits<std::int64_t>::max()}};

/// All notes of one life of a process, from any number of files.
struct Life {
    FlightPeer who;
    std::map<std::uint64_t, FlightEvent> events;  // by number
    Tick first;
    Tick last;
    bool ended = false;
    std::string note;
    bool was_asked = false;
    std::vector<const FlightFile*> files;

    bool has_events_in(const Window& window) const {
        return std::ranges::any_of(events, [&](const auto& noted) { return window.has(noted.second.tick); });
    }
};

std::vector<Life> lives_of(const FileGroup& group) {
    std::map<std::tuple<int, Identity>, Life> lives;
    for (const FlightFile* file : group) {
        const FlightPeer who = who_is(file->machine, file->head.source.process);
        Life& life = lives[{order_of(who), file->head.source.incarnation}];
        life.who = who;
        life.ended |= file->head.mark.reason == IncidentReason::Ended;
        if (!file->note.empty()) { life.note = file->note; }
        life.was_asked |= file->head.mark.reason == IncidentReason::Asked;
        life.files.push_back(file);
        for (const NumberedEvent& noted : file->events) { life.events.emplace(noted.number, noted.event); }
    }
    std::vector<Life> out;
    for (auto& [key, life] : lives) {
        const auto tick_of = [](const auto& noted) { return noted.second.tick; };
        if (!life.events.empty()) {
            life.first = tick_of(*std::ranges::min_element(life.events, {}, tick_of));
            life.last = tick_of(*std::ranges::max_element(life.events, {}, tick_of));
        }
        out.push_back(std::move(life));
    }
    return out;
}

/// The files that were written about an incident in the window. If there is none, all files.
std::vector<const FlightFile*> files_about(const Life& life, const Window& window) {
    std::vector<const FlightFile*> files;
    for (const FlightFile* file : life.files) {
        if (window.has(file->head.mark.tick)) { files.push_back(file); }
    }
    return files.empty() ? life.files : files;
}

void add_events(const Life& life, const Window& window, Process& process, Incident& incident) {
    std::optional<Tick> first;
    for (const auto& [number, event] : life.events) {
        if (!window.has(event.tick)) { continue; }
        first = std::min(first.value_or(event.tick), event.tick);
        process.last = std::max(process.last, event.tick);
        const bool is_state = event.kind == FlightKind::State || event.kind == FlightKind::Phase;
        if (is_state) { process.clock_error = std::max(process.clock_error, event.lasts); }
        incident.timeline.push_back({event.tick, incident.processes.size(), event});
    }
    process.first = first.value_or(life.first);
    if (!first) { process.last = life.last; }
}

void add_end(Tick last, Incident& incident) {
    const FlightEvent end{
        .tick = last, .kind = FlightKind::Incident, .detail = static_cast<std::uint8_t>(IncidentReason::Ended)};
    incident.timeline.push_back({last, incident.processes.size(), end});
}

/// A process that ended before the window is part of the incident, because nothing shows that it is back.
void add(const Life& life, const Window& window, Incident& incident) {
    const bool has_end = life.last < window.to;
    Process process{.name = name_of(incident, life.who),
                    .who = life.who,
                    .ended = life.ended && has_end,
                    .note = has_end ? life.note : "",
                    .was_asked = life.was_asked && has_end,
                    .files = {}};
    const auto before = std::ranges::count(incident.processes, life.who, &Process::who);
    if (before > 0 && life.who.kind == FlightPeer::Kind::Axis) { process.name += ", restarted"; }
    if (before > 0 && life.who.kind == FlightPeer::Kind::Coordinator) {
        process.name += fmt::format(" ({})", before + 1);
    }
    for (const FlightFile* file : files_about(life, window)) {
        process.files.push_back(file->path.string());
        for (const analysis::Damage& damage : file->damages) {
            incident.unread.push_back(file->path.string() + ": " + analysis::damage_sentence(damage));
        }
    }
    add_events(life, window, process, incident);
    if (process.ended && window.has(life.last)) { add_end(life.last, incident); }
    incident.processes.push_back(std::move(process));
}

void name_the_absent(Incident& incident) {
    const auto lacks = [&](FlightPeer who) {
        return std::ranges::find(incident.processes, who, &Process::who) == incident.processes.end();
    };
    if (lacks(kFlightCoordinator)) { incident.absent.push_back("coordinator"); }
    for (const MotorIndex i : motor_indices(incident.motors.size())) {
        if (lacks(flight_axis(i))) { incident.absent.push_back(name_of(incident, flight_axis(i))); }
    }
}

/// Whether the life belongs to the incident in the window: it has notes there, or it is the last of its process that
/// has ended before, or all its notes are missing.
bool belongs_to(const Life& life, const Window& window, const std::vector<Life>& lives) {
    if (life.events.empty() || life.has_events_in(window)) { return true; }
    const auto replaces = [&](const Life& other) {
        return &other != &life && other.who == life.who && other.first < window.to && other.last >= life.last;
    };
    return life.ended && life.last < window.from && std::ranges::none_of(lives, replaces);
}

/// When the incident happened: the first note of it, or else its last note.
Tick time_of(const Incident& incident) {
    const auto mark =
        std::ranges::find(incident.timeline, FlightKind::Incident, [](const Entry& e) { return e.event.kind; });
    if (mark != incident.timeline.end()) { return mark->tick; }
    return incident.timeline.empty() ? Tick{} : incident.timeline.back().tick;
}

/// The wall time of the first file that was written about an incident in the window. If there is none, the wall time of
/// `at`, by the file with the nearest mark.
std::int64_t wall_us_of(const FileGroup& group, const Window& window, Tick at) {
    std::optional<std::int64_t> first;
    const FlightFile* nearest = group.front();
    const auto distance_us = [&](const FlightFile& file) {
        const double ticks = static_cast<double>(at.value) - static_cast<double>(file.head.mark.tick.value);
        return ticks * 1e6 / file.machine.ticks_per_second();
    };
    for (const FlightFile* file : group) {
        const IncidentMark& mark = file->head.mark;
        if (window.has(mark.tick)) { first = std::min(first.value_or(mark.wall_us), mark.wall_us); }
        if (std::abs(distance_us(*file)) < std::abs(distance_us(*nearest))) { nearest = file; }
    }
    return first ? *first : nearest->head.mark.wall_us + std::llround(distance_us(*nearest));
}

Incident incident_in(const Window& window, const FileGroup& group, const std::vector<Life>& lives) {
    Incident incident{.machine = group.front()->machine};
    const Kinematics kinematics(incident.machine);
    for (const MotorIndex m : motor_indices(kinematics.motors().size())) {
        incident.motors.push_back(kinematics.label(m));
    }
    for (const Life& life : lives) {
        if (belongs_to(life, window, lives)) { add(life, window, incident); }
    }
    std::ranges::stable_sort(incident.timeline, {}, &Entry::tick);
    name_the_absent(incident);
    incident.wall_us = wall_us_of(group, window, time_of(incident));
    return incident;
}

void add_incidents(const FileGroup& group, std::vector<Incident>& incidents) {
    const std::vector<Life> lives = lives_of(group);
    Incident all = incident_in(kAllTime, group, lives);
    Tick from = kAllTime.from;
    for (const Tick boundary : boundaries(all)) {
        incidents.push_back(incident_in({from, boundary}, group, lives));
        from = boundary;
    }
    incidents.push_back(from == kAllTime.from ? std::move(all) : incident_in({from, kAllTime.to}, group, lives));
}

}  // namespace

std::vector<Incident> incidents_of(const std::vector<FlightFile>& files) {
    std::vector<Incident> incidents;
    for (const FileGroup& group : grouped(files)) { add_incidents(group, incidents); }
    return incidents;
}

}  // namespace lockstep::incident
