// lockstep flight
#include <memory>

#include "clients/lockstep/live/machine_choice.hpp"
#include "clients/lockstep/live/voice.hpp"
#include "clients/lockstep/verb.hpp"
#include "idl/proto/report.pb.h"
#include "services/flight/flight_recorder.hpp"
#include "services/flight/incident_file.hpp"
#include "services/runtime/directories.hpp"

namespace lockstep {
namespace {

/// What living processes noted, read as they run, or stand still: they need do nothing for it.
void write_living(const std::filesystem::path& rings, const MachineConfig& machine, proto::FlightReport& report) {
    for (const auto& path : rings_in(rings)) {
        const auto snapshot = read_ring(path);
        if (!snapshot || snapshot->source.directory != incident_directory(machine)) { continue; }
        const Tick last = snapshot->events.empty() ? Tick{} : snapshot->events.back().event.tick;
        const auto file = write_incident(*snapshot, {IncidentReason::Asked, last, wall_clock_us()});
        file ? report.add_files(file->string()) : report.add_problems(file.error());
    }
}

proto::FlightReport write_all(const MachineConfig& machine) {
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

ExitCode flight(const LiveOptions& options) {
    Voice voice(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return voice.fail(machine.error()); }
    const proto::FlightReport report = write_all(machine->config);
    if (report.files().empty() && report.problems().empty()) {
        return voice.fail(unreachable("no process of machine '" + machine->config.name +
                                      "' on this host keeps a flight recorder: is it up? record { flight { kept } } in "
                                      "its file switches it off"));
    }
    for (const std::string& problem : report.problems()) { voice.warn(problem); }
    for (const std::string& file : report.files()) { voice.say(file); }
    if (!report.files().empty()) { voice.say("\nread them: lockstep analyze --incident " + report.directory()); }
    voice.report(report);
    return report.problems().empty() ? kExitDone : kExitFailed;
}

}  // namespace

void add_flight(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand(
        "flight", "write down what each process of the machine on this host heard, decided and said last");
    const auto options = std::make_shared<LiveOptions>();
    add_live_options(*verb, *options);
    verb->footer(
        "At a fault each process writes this by itself; this asks at any time, also of processes that are stopped,\n"
        "hang, or have died.\n" +
        footer("  lockstep flight\n  lockstep analyze --incident /var/lib/lockstep/mill/record/incidents\n"));
    verb->callback([&action, options] { action = [options] { return flight(*options); }; });
}

}  // namespace lockstep
