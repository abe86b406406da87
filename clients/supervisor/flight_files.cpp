#include "clients/supervisor/flight_files.hpp"

#include "services/files/directories.hpp"
#include "services/flight/flight_recorder.hpp"
#include "services/flight/incident_file.hpp"

namespace lockstep {
namespace {

/// Writes the notes of living processes, which may run or stand still and need not cooperate.
void write_living(const std::filesystem::path& rings, const MachineSetup& machine, proto::FlightReport& report) {
    for (const auto& path : rings_in(rings)) {
        const auto snapshot = read_ring(path);
        if (!snapshot || snapshot->source.directory != incident_directory(machine)) { continue; }
        const Tick last = snapshot->events.empty() ? Tick{} : snapshot->events.back().event.tick;
        const auto file = write_incident(*snapshot, {IncidentReason::Asked, last, wall_clock_us()});
        file ? report.add_files(file->string()) : report.add_problems(file.error());
    }
}

}  // namespace

proto::FlightReport write_flight_files(const MachineSetup& machine) {
    proto::FlightReport report;
    report.set_directory(incident_directory(machine).string());
    for (const auto& rings : memory_directories()) {
        const LeftRings left = save_left_rings(rings, incident_directory(machine));
        for (const auto& file : left.saved) { report.add_files(file.string()); }
        for (const std::string& problem : left.problems) { report.add_problems(problem); }
        write_living(rings, machine, report);
    }
    return report;
}

}  // namespace lockstep
