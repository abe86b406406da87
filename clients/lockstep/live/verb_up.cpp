// lockstep up
#include <map>

#include <CLI/CLI.hpp>

#include "clients/lockstep/live/bring_up.hpp"
#include "clients/lockstep/live/live_options.hpp"
#include "clients/lockstep/live/reports.hpp"
#include "clients/lockstep/live/status_text.hpp"
#include "clients/lockstep/live/take_down.hpp"
#include "clients/lockstep/verb.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

struct UpOptions : LiveOptions {
    std::string fpga;
    bool standby = false;
    std::string on_takeover = "stop";
    bool foreground = false;
};

ExitCode say_up(const Session& session, const StateDirectory& state, Voice& voice) {
    const proto::StatusReport report = status_report(session);
    voice.report(report);
    voice.say("machine '" + report.machine() + "' is up; logs in " + state.path().string());
    voice.say(status_text(report) + (report.has_fault() ? "" : "next: lockstep home"));
    return report.has_fault() ? kExitFailed : kExitDone;
}

ExitCode up(const UpOptions& options) {
    Voice voice(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return voice.fail(machine.error()); }
    const StateDirectory state(machine->config.name);
    const std::map<std::string, FpgaKind> kinds{{"sim", FpgaKind::Sim}, {"shm", FpgaKind::Shared}};
    const auto kind = kinds.find(options.fpga);
    const Layout layout{kind == kinds.end() ? FpgaKind::AsConfigured : kind->second, options.standby,
                        options.on_takeover == "continue"};
    const auto lines = prepare(*machine, layout, state, voice);
    if (!lines) { return voice.fail(lines.error()); }
    if (options.foreground) {
        supervise(state, *lines);
        return kExitDone;
    }
    const auto since = monotonic_now();
    const auto supervisor = supervise_in_background(state, *lines);
    if (!supervisor) { return voice.fail(supervisor.error()); }
    const auto session = wait_until_up(*machine, state, since);
    if (session) { return say_up(*session, state, voice); }
    (void)take_down(state, *supervisor);
    Failure failure = session.error();
    failure.errors.front().message += failure.errors.front().message.ends_with('\n') ? "" : "\n";
    failure.errors.front().message +=
        "machine '" + machine->config.name + "' is not up; what was started is ended again";
    return voice.fail(failure);
}

}  // namespace

void add_up(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand(
        "up", "start those of a machine's processes that belong on this host, and wait until it is ready");
    const auto options = std::make_shared<UpOptions>();
    verb->add_option("--fpga", options->fpga,
                     "the devices, instead of the configuration's: sim, simulated in the axes' processes; shm, in "
                     "processes of their own")
        ->check(CLI::IsMember({"sim", "shm"}));
    CLI::Option* standby = verb->add_flag(
        "--standby", options->standby, "start a second coordinator that takes over, at rest, when the first one fails");
    verb->add_option("--on-takeover", options->on_takeover,
                     "with --standby, what becomes of a program in motion then: stop; or continue, if every axis rests "
                     "where the first one's frames end")
        ->check(CLI::IsMember({"stop", "continue"}))
        ->needs(standby)
        ->capture_default_str();
    verb->add_flag("--foreground", options->foreground,
                   "supervise in this process until SIGTERM or Ctrl-C; log to standard error");
    add_live_options(*verb, *options);
    verb->footer(
        "Configuration, process record and logs are kept in $LOCKSTEP_STATE/MACHINE; where that is not set, in\n"
        "/run/lockstep/MACHINE (root) or $XDG_RUNTIME_DIR/lockstep/MACHINE.\n" +
        footer("  lockstep up --machine mill.textproto\n  lockstep up --machine mill.textproto --fpga shm\n"
               "  lockstep up --machine mill.textproto --standby --on-takeover continue\n"));
    verb->callback([&action, options] { action = [options] { return up(*options); }; });
}

}  // namespace lockstep
