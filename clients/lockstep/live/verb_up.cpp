// lockstep up
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/session/parts.hpp"
#include "clients/session/reports.hpp"
#include "clients/session/status_text.hpp"
#include "clients/supervisor/bring_up.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/supervisor/other_hosts.hpp"
#include "clients/supervisor/page.hpp"
#include "clients/supervisor/take_down.hpp"
#include "core/kinematics/motors.hpp"
#include "services/documents/rules/machine_warnings.hpp"
#include "services/network/host_name.hpp"

namespace lockstep {
namespace {

struct UpOptions : LiveOptions {
    std::string fpga;
    bool standby = false;
    std::string on_takeover = "stop";
    bool web = false;
    bool foreground = false;
    std::optional<double> wait_s;  // for the parts of other hosts
    AllHosts all;
};

constexpr std::chrono::seconds kPagePatience{20};
constexpr double kGlance_s = 2;       // wait for other hosts' parts, so that the last host to start reports them
constexpr double kWaitForAll_s = 60;  // with --all, which starts all parts

std::string names_here(const MachineSetup& machine, const Placement& placed) {
    std::string names = placed.coordinator ? "the coordinator" : "";
    for (const MotorIndex i : placed.axes) { names += (names.empty() ? "" : ", ") + motor_name(machine, i); }
    return names;
}

void print_page(const OwnParts& parts, const StateDirectory& state, Output& output) {
    if (std::ranges::find(parts.lines, kWeb, &ServiceLine::name) == parts.lines.end()) { return; }
    const auto page = await_page(state, kPagePatience);
    if (!page) { return output.warn(page.error()); }
    output.print("the page to operate it, and the one to view it:\n" +
                 page->substr(0, page->find_last_not_of('\n') + 1));
}

ExitCode report_up(const Session& session, const StateDirectory& state, Output& output) {
    const proto::StatusReport report = status_report(session);
    output.report(report, machine_warnings(session.config()));
    const bool is_spread = hosts_of(session.config()).size() > 1;
    output.print(fmt::format("machine '{}' is up; its logs are in {}{}", report.machine(), state.path().string(),
                             (is_spread ? ", on each host" : "")));
    output.print(status_text(report) + (report.has_fault() ? "" : "next: lockstep home"));
    return report.has_fault() ? kExitFailed : kExitDone;
}

/// Reports that this host's parts run. Parts of other hosts may start later.
ExitCode report_part_up(const Session& session, const Placement& placed, const StateDirectory& state, Output& output) {
    proto::StatusReport report = status_report(session);
    add_awaited(session, report);
    output.report(report, machine_warnings(session.config()));
    if (!placed.empty()) {
        output.print(fmt::format("machine '{}': {} up on this host, {}; logs in {}", report.machine(),
                                 names_here(session.config(), placed), host_name(), state.path().string()));
    }
    output.print(awaited_text(report).empty() ? status_text(report) : awaited_text(report) + "see: lockstep status");
    return kExitDone;
}

/// Waits for the other parts of a machine on several hosts, and reports.
ExitCode await_and_report(Session& session, const UpOptions& options, const Placement& placed,
                          const StateDirectory& state, Output& output) {
    const double asked_s = options.wait_s.value_or(options.all.asked ? kWaitForAll_s : 0);
    const bool whole =
        await_others(session, std::chrono::milliseconds(std::llround(std::max(asked_s, kGlance_s) * 1e3)));
    if (whole && asked_s > 0) { return report_up(session, state, output); }
    const ExitCode code = report_part_up(session, placed, state, output);
    return whole || asked_s == 0 ? code : kExitUnreachable;
}

ExitCode give_up(const ChosenMachine& machine, const StateDirectory& state, const ProcessRecord& supervisor,
                 Failure failure, Output& output) {
    (void)take_down(state, supervisor);
    std::string& message = failure.errors.front().message;
    message += fmt::format("{}machine '{}' is not up; the processes that were started are ended again",
                           message.ends_with('\n') ? "" : "\n", machine.config.name);
    return output.fail(failure);
}

ExitCode up_here(const UpOptions& options, const ChosenMachine& machine, Output& output) {
    const StateDirectory state(machine.config.name);
    const std::map<std::string, FpgaKind> kinds{{"sim", FpgaKind::Sim}, {"shm", FpgaKind::Shared}};
    const auto kind = kinds.find(options.fpga);
    const Layout layout{kind == kinds.end() ? FpgaKind::AsConfigured : kind->second, options.standby,
                        options.on_takeover == "continue", options.web};
    const auto parts = prepare(machine, layout, state, output);
    if (!parts) { return output.fail(parts.error()); }
    if (options.foreground) {
        supervise(state, parts->lines);
        return kExitDone;
    }
    const auto supervisor = supervise_in_background(state, parts->lines);
    if (!supervisor) { return output.fail(supervisor.error()); }
    auto session = wait_until_up(machine, *parts, state, *supervisor);
    if (!session) { return give_up(machine, state, *supervisor, session.error(), output); }
    const ExitCode code = is_alone(machine.config, parts->placed)
                              ? report_up(*session, state, output)
                              : await_and_report(*session, options, parts->placed, state, output);
    print_page(*parts, state, output);
    return code;
}

/// Used if every part belongs on another host.
ExitCode up_elsewhere(const UpOptions& options, const ChosenMachine& machine, Output& output) {
    auto session = Session::join(machine, Purpose::Look);
    if (!session) { return output.fail(session.error()); }
    return await_and_report(*session, options, {}, StateDirectory(machine.config.name), output);
}

/// The words of the command for the other hosts.
std::vector<std::string> words_of(const UpOptions& options) {
    std::vector<std::string> words{"up"};
    if (!options.fpga.empty()) { words.insert(words.end(), {"--fpga", options.fpga}); }
    if (options.standby) { words.insert(words.end(), {"--standby", "--on-takeover", options.on_takeover}); }
    if (options.web) { words.emplace_back("--web"); }
    return words;
}

ExitCode up(const UpOptions& options) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    OtherHosts others(options.all, machine->config, options.machine_file, words_of(options));
    const bool is_here = !options.all.asked || !placed_on(machine->config, host_name()).empty();
    const ExitCode here = is_here ? up_here(options, *machine, output) : up_elsewhere(options, *machine, output);
    constexpr std::size_t kBrief = 1;  // only the line that a host is up; the parts that it waits for are up by now
    return others.finish(output, kBrief) ? here : std::max(here, kExitFailed);
}

}  // namespace

void add_up(Verb command) {
    const Verb verb = command.add_verb("up",
                                       "start the machine's processes of this host\n"
                                       "The command waits until they are ready.");
    const auto options = std::make_shared<UpOptions>();
    verb.add_option("--fpga", options->fpga,
                    "simulated devices instead of those of the configuration: sim: in the axes' processes; shm: in "
                    "separate processes")
        .one_of({"sim", "shm"});
    const Argument standby =
        verb.add_flag("--standby", options->standby,
                      "start a second coordinator that takes over, with the axes at rest, when the first one fails");
    verb.add_option(
            "--on-takeover", options->on_takeover,
            "with --standby: stop a program that is in motion at the takeover; or continue it, if every axis rests "
            "where the last owner's frames end")
        .one_of({"stop", "continue"})
        .needs(standby)
        .with_default();
    verb.add_flag("--web", options->web,
                  "also serve the page on the coordinator's host, and print its address; web { } in the machine's file "
                  "does the same, and sets the address");
    const Argument foreground =
        verb.add_flag("--foreground", options->foreground,
                      "supervise in this process until SIGTERM or Ctrl-C; log to standard error");
    add_all_hosts(verb, options->all).excludes(foreground);
    verb.add_option("--wait", options->wait_s,
                    "for a machine on several hosts: also wait until all of it is ready, at most this many "
                    "seconds; this host's part stays up in any case")
        .in_range(0.0, 86'400.0);
    add_live_options(verb, *options);
    verb.footer(
        "For a machine on several hosts, run it on each, in any order and at any time: it starts the parts that "
        "belong\n"
        "there, prints what the machine still waits for, and ends when this host's part is up.\n"
        "Configuration, process record and logs are kept in $LOCKSTEP_STATE/MACHINE; without it, in\n"
        "/run/lockstep/MACHINE (root) or $XDG_RUNTIME_DIR/lockstep/MACHINE.\n" +
        footer("  lockstep up --machine mill.textproto\n  lockstep up --machine mill.textproto --fpga shm\n"
               "  lockstep up --machine mill.textproto --standby --on-takeover continue\n"
               "  lockstep up --web\n  lockstep up --wait 60\n  lockstep up --all --ssh 'ssh -i key'\n"));
    verb.action([options] { return up(*options); });
}

}  // namespace lockstep
