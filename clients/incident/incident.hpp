// An incident: what all processes noted around one fault, in one order, by machine time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "clients/incident/flight_file.hpp"

namespace lockstep::incident {

/// One life of a process, of which something was kept.
struct Process {
    std::string name;  // "axis X", "coordinator"; "axis X, started anew"
    FlightPeer who;
    Identity incarnation = 0;
    Tick first;              // noted
    Tick last;               // noted
    bool ended = false;      // unasked, after `last`
    std::string note;        // why it ended by itself; empty: unknown
    bool was_asked = false;  // its notes were read when somebody asked, whether it ran or not
    Ticks clock_error;       // its times are machine time within
    std::vector<std::string> files;
};

struct Entry {
    Tick tick;
    std::size_t process = 0;
    FlightEvent event;
};

struct Incident {
    MachineConfig machine;
    std::int64_t wall_us = 0;         // when its first file was written
    std::vector<Process> processes;   // the coordinators, then the axes as configured; each in the order of its lives
    std::vector<Entry> timeline;      // in the order of time
    std::vector<std::string> unread;  // what could not be read, by file and place
    std::vector<std::string> absent;  // processes of which there is no file

    double seconds(Ticks ticks) const { return machine.microseconds(ticks) * 1e-6; }
    Ticks slots(std::int64_t count) const { return machine.slot_ticks() * count; }
};

/// The files by incident, the oldest first: those whose marks follow each other within seconds of machine time. Files
/// of one process may overlap. `files` are of one machine.
std::vector<Incident> incidents_of(const std::vector<FlightFile>& files);

}  // namespace lockstep::incident
