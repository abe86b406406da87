// lockstep down
#include <fmt/format.h>

#include <algorithm>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/session/session.hpp"
#include "clients/session/waits.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/supervisor/other_hosts.hpp"
#include "clients/supervisor/state_directory.hpp"
#include "clients/supervisor/take_down.hpp"
#include "clients/text/output.hpp"
#include "idl/proto/report.pb.h"
#include "services/documents/placement.hpp"
#include "services/network/host_name.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

struct DownOptions : LiveOptions {
    AllHosts all;
};

constexpr auto kDownPatience = 10s;
constexpr auto kLastStates = 300ms;  // so that clients receive the final states of the job's axes

/// Brings a machine that moves to rest on its path. A machine that does not answer is taken down directly.
void bring_to_rest(const ChosenMachine& machine, Output& output) {
    auto session = Session::join(machine, Purpose::Command);
    if (!session || !reach(*session, 1s)) { return; }
    const auto moves = [&] {
        const MachinePhase phase = session->state()->state.phase;
        return phase == MachinePhase::Homing || phase == MachinePhase::Jogging || phase == MachinePhase::Running ||
               phase == MachinePhase::Stopping;
    };
    if (!moves()) { return; }
    output.print("stopping first ...");
    if (!send_command(*session, {.kind = CommandKind::Stop})) { return; }
    (void)session->receive_until(kDownPatience, [&] { return !moves(); });
    const auto until = monotonic_now() + kLastStates;
    while (monotonic_now() < until) { session->receive(until - monotonic_now()); }
}

ExitCode report_done(const std::string& text, Output& output) {
    proto::CommandReport report;
    report.set_accepted(true);
    report.set_text(text);
    output.report(report);
    output.print(text);
    return kExitDone;
}

/// Without the supervisor's record, those that the process table shows.
ExitCode end_processes(const std::string& machine, Output& output) {
    const StateDirectory state(machine);
    if (const auto trouble = state.record_trouble()) {
        output.warn(fmt::format("machine '{}': {}: this command ends the processes that the host's process table shows",
                                machine, *trouble));
    }
    const TakenDown taken = take_down(state);
    if (taken.left.empty()) {
        return report_done(fmt::format("machine '{}' is down; ended {}", machine, fmt::join(taken.ended, ", ")),
                           output);
    }
    return output.fail(failed(fmt::format("could not end {} of machine '{}'; see {}/processes",
                                          fmt::join(taken.left, ", "), machine, state.path().string())));
}

ExitCode down_here(const LiveOptions& options, Output& output) {
    const bool is_named = !options.machine_file.empty() || std::getenv("LOCKSTEP_MACHINE") != nullptr;
    if (!is_named) {
        const std::vector<std::string> up = machines_up();
        if (up.empty()) { return report_done("no machine is up on this host", output); }
        if (up.size() == 1 && StateDirectory(up.front()).is_lost()) { return end_processes(up.front(), output); }
    }
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    if (StateDirectory(machine->config.name).running().empty()) {
        return report_done("no process of machine '" + machine->config.name + "' is up on this host", output);
    }
    bring_to_rest(*machine, output);
    return end_processes(machine->config.name, output);
}

ExitCode down(const DownOptions& options) {
    Output output(options.json);
    if (!options.all.asked) { return down_here(options, output); }
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    OtherHosts others(options.all, machine->config, options.machine_file, {"down"});
    const bool is_here = !placed_on(machine->config, host_name()).empty();
    const ExitCode here = is_here ? down_here(options, output) : kExitDone;
    return others.finish(output) ? here : std::max(here, kExitFailed);
}

}  // namespace

void add_down(Verb command) {
    const Verb verb = command.add_verb("down", "stop the machine on its path, then end its processes of this host");
    const auto options = std::make_shared<DownOptions>();
    add_all_hosts(verb, options->all);
    add_live_options(verb, *options);
    verb.footer("If no machine is up, it prints this and exits with 0.\n" +
                footer("  lockstep down\n  lockstep down --all\n"));
    verb.action([options] { return down(*options); });
}

}  // namespace lockstep
