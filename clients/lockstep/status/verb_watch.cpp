// lockstep watch
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/status/screen.hpp"
#include "clients/lockstep/status/watch_text.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/session/reports.hpp"
#include "clients/session/session.hpp"
#include "clients/session/waits.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/colour.hpp"
#include "clients/text/output.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kRedrawPeriod = 100ms;  // on a terminal
constexpr nanoseconds kLinePeriod = 1s;       // elsewhere

/// The status, with the incident files if there is a fault that they may explain.
proto::StatusReport watched(const Session& session) {
    proto::StatusReport report = status_report(session);
    if (report.has_fault()) { add_incidents(session.config(), report); }
    return report;
}

/// Also continues without messages. The age of the status shows that.
void watch_on_screen(Session& session, const StopSignal& stop, Ink ink) {
    const SlackScale scale = slack_scale(session.config().timing);
    Screen screen;
    while (!stop.requested() && !screen.pressed('q')) {
        screen.draw(watch_text(watched(session), scale, ink) + "\nq or Ctrl-C quits; the machine continues\n");
        const nanoseconds next = monotonic_now() + kRedrawPeriod;
        while (!stop.requested() && monotonic_now() < next) { session.receive(next - monotonic_now()); }
    }
}

void watch_in_lines(Session& session, const StopSignal& stop, Output& output) {
    const SlackScale scale = slack_scale(session.config().timing);
    while (!stop.requested()) {
        const proto::StatusReport report = watched(session);
        output.report(report);
        output.print(watch_line(report, scale));
        const nanoseconds next = monotonic_now() + kLinePeriod;
        while (!stop.requested() && monotonic_now() < next) {
            session.receive(std::min(kRedrawPeriod, next - monotonic_now()));
        }
    }
}

ExitCode watch(const LiveOptions& options) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    auto session = Session::open(*machine, Purpose::Look);
    if (!session) { return output.fail(session.error()); }
    if (session->config_differs()) {
        output.warn("the coordinator runs another configuration than this command reads");
    }
    await_axes(*session);
    await_healths(*session, 300ms);
    const StopSignal stop;
    if (output.is_terminal() && !output.json()) {
        watch_on_screen(*session, stop, wants_colour() ? Ink::Colour : Ink::Plain);
    } else {
        watch_in_lines(*session, stop, output);
    }
    return kExitDone;
}

}  // namespace

void add_watch(Verb command) {
    const Verb verb = command.add_verb("watch",
                                       "the machine's status, ten times a second\n"
                                       "Without a terminal, the command prints a line a second.");
    const auto options = std::make_shared<LiveOptions>();
    add_live_options(verb, *options);
    verb.footer(
        footer("  lockstep watch\n  lockstep watch | tee watched.txt\n"
               "  lockstep watch --json | jq -c '.axes[] | [.name, .health.setpoint_slack_ms.min]'\n"));
    verb.action([options] { return watch(*options); });
}

}  // namespace lockstep
