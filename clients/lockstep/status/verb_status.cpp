// lockstep status
#include <iostream>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/session/parts.hpp"
#include "clients/session/reports.hpp"
#include "clients/session/session.hpp"
#include "clients/session/status_text.hpp"
#include "clients/session/waits.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/output.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

ExitCode status(const LiveOptions& options) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    auto session = Session::open(*machine, Purpose::Look);
    if (!session) { return output.fail(session.error()); }
    await_axes(*session);
    await_healths(*session, 1s);
    (void)session->receive_until(1s, [&] { return session->values().has_any(); });
    if (session->config_differs()) {
        output.warn("the coordinator runs another configuration than this command reads");
    }
    proto::StatusReport report = status_report(*session);
    add_incidents(session->config(), report);
    add_awaited(*session, report);
    output.report(report);
    if (!output.json()) { std::cout << status_text(report) << awaited_text(report) << std::flush; }
    return kExitDone;
}

}  // namespace

void add_status(Verb command) {
    const Verb verb = command.add_verb("status", "the machine's state and the positions of its axes");
    const auto options = std::make_shared<LiveOptions>();
    add_live_options(verb, *options);
    verb.footer(footer("  lockstep status\n  lockstep status --json | jq .phase\n"));
    verb.action([options] { return status(*options); });
}

}  // namespace lockstep
