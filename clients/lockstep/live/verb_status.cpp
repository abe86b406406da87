// lockstep status
#include <unistd.h>

#include <iostream>

#include "clients/lockstep/live/reports.hpp"
#include "clients/lockstep/live/session.hpp"
#include "clients/lockstep/live/status_text.hpp"
#include "clients/lockstep/live/voice.hpp"
#include "clients/lockstep/verb.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kRedrawPeriod = 100ms;  // on a terminal
constexpr nanoseconds kBlockPeriod = 1s;      // elsewhere

struct StatusOptions : LiveOptions {
    bool watch = false;
};

void show(const Session& session, Voice& voice, bool redraw) {
    const proto::StatusReport report = status_report(session);
    voice.report(report);
    if (redraw) { std::cout << "\x1b[H\x1b[J"; }
    if (!voice.json()) { std::cout << status_text(report) << std::flush; }
}

/// Until a signal; also while nobody speaks, which the age then shows.
void watch(Session& session, Voice& voice) {
    const StopSignal stop;
    const bool redraw = voice.is_terminal() && !voice.json();
    const nanoseconds period = redraw ? kRedrawPeriod : kBlockPeriod;
    while (!stop.requested()) {
        show(session, voice, redraw);
        const nanoseconds next = monotonic_now() + period;
        while (!stop.requested() && monotonic_now() < next) {
            session.listen(std::min(kRedrawPeriod, next - monotonic_now()));
        }
    }
}

ExitCode status(const StatusOptions& options) {
    Voice voice(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return voice.fail(machine.error()); }
    auto session = Session::open(*machine);
    if (!session) { return voice.fail(session.error()); }
    (void)session->reach_axes(500ms);  // an axis that is not heard is shown as such
    session->await_healths(300ms);
    if (session->config_differs()) { voice.warn("the coordinator runs another configuration than this command reads"); }
    options.watch ? watch(*session, voice) : show(*session, voice, false);
    return kExitDone;
}

}  // namespace

void add_status(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("status", "what the machine does and where its axes are");
    const auto options = std::make_shared<StatusOptions>();
    verb->add_flag("--watch", options->watch, "again and again until Ctrl-C; once a second where there is no terminal");
    add_live_options(*verb, *options);
    verb->footer(footer("  lockstep status\n  lockstep status --watch\n  lockstep status --json | jq .phase\n"));
    verb->callback([&action, options] { action = [options] { return status(*options); }; });
}

}  // namespace lockstep
