// lockstep flight
#include <memory>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/supervisor/flight_files.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/output.hpp"

namespace lockstep {
namespace {

ExitCode flight(const LiveOptions& options) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    const proto::FlightReport report = write_flight_files(machine->config);
    if (report.files().empty() && report.problems().empty()) {
        return output.fail(unreachable("no process of machine '" + machine->config.name +
                                       "' on this host has a flight recorder; check that the machine is up, and that "
                                       "record { flight { kept } } in "
                                       "its file is not false"));
    }
    for (const std::string& problem : report.problems()) { output.warn(problem); }
    for (const std::string& file : report.files()) { output.print(file); }
    if (!report.files().empty()) { output.print("\nread them: lockstep analyze --incident " + report.directory()); }
    output.report(report);
    return report.problems().empty() ? kExitDone : kExitFailed;
}

}  // namespace

void add_flight(Verb command) {
    const Verb verb = command.add_verb("flight",
                                       "write what each process last received and decided to files\n"
                                       "The files contain what each process on this host last received, decided and "
                                       "published.");
    const auto options = std::make_shared<LiveOptions>();
    add_live_options(verb, *options);
    verb.footer(
        "At a fault each process writes these files by itself. The command works at any time, also for processes\n"
        "that are stopped, hang, or have died.\n" +
        footer("  lockstep flight\n  lockstep analyze --incident /var/lib/lockstep/mill/record/incidents\n"));
    verb.action([options] { return flight(*options); });
}

}  // namespace lockstep
