// An incident: the notes of all processes around one fault, ordered by machine time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "clients/incident/flight_file.hpp"

namespace lockstep::incident {

/// One life (incarnation) of a process with notes.
struct Process {
    std::string name;  // "axis X", "motor Y2", "coordinator"; "axis X, restarted"
    FlightPeer who;
    Identity incarnation = 0;
    Tick first;              // time of its first note
    Tick last;               // time of its last note
    bool ended = false;      // without a request, after `last`
    std::string note;        // why it ended itself; empty if unknown
    bool was_asked = false;  // its notes were read on request; it may run or not
    Ticks clock_error;       // uncertainty of its times against machine time
    std::vector<std::string> files;
};

struct Entry {
    Tick tick;
    std::size_t process = 0;
    FlightEvent event;
};

struct Incident {
    MachineConfig machine;
    std::vector<std::string> motors;  // of the machine: "axis X", "motor Y2"
    std::int64_t wall_us = 0;  // when its first file was written; without a file of its own, about when it happened
    std::vector<Process> processes;   // the coordinators, then the axes as configured; each with its lives in order
    std::vector<Entry> timeline;      // in the order of time
    std::vector<std::string> unread;  // errors in reading, by file and place
    std::vector<std::string> absent;  // processes without a file

    double seconds(Ticks ticks) const { return machine.microseconds(ticks) * 1e-6; }
    Ticks slots(std::int64_t count) const { return machine.slot_ticks() * count; }
};

/// Combines the files and separates the incidents in them, the oldest first. One file may hold several incidents, and
/// files of one process may overlap. Notes without a sign that the machine continued in between (separation.hpp) are
/// one incident. All `files` must be of one machine.
std::vector<Incident> incidents_of(const std::vector<FlightFile>& files);

}  // namespace lockstep::incident
