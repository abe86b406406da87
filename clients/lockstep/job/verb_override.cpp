// lockstep override
#include <fmt/format.h>

#include <optional>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/session/control/lease_turn.hpp"
#include "clients/session/refusal.hpp"
#include "clients/session/session.hpp"
#include "clients/session/waits.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/output.hpp"
#include "core/overrides.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {
namespace {

struct OverrideOptions : LiveOptions {
    std::optional<int> feed_percent;
    std::optional<int> rapid_percent;
};

std::string text_of(const Overrides& overrides) {
    return fmt::format("feed {} %, rapid {} %", overrides.feed_percent, overrides.rapid_percent);
}

ExitCode turn(const OverrideOptions& options) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    auto session = Session::open(*machine, Purpose::Command);
    if (!session) { return output.fail(session.error()); }
    Overrides overrides = session->state()->state.overrides;
    overrides.feed_percent = options.feed_percent.value_or(overrides.feed_percent);
    overrides.rapid_percent = options.rapid_percent.value_or(overrides.rapid_percent);
    if (options.feed_percent || options.rapid_percent) {
        const LeaseTurn turn(*session, options.take);
        if (!turn.answer()) { return output.fail(turn.answer().error()); }
        if (turn.is_refused()) { return print_refusal(*turn.answer(), output); }
        const auto reply = send_command(*session, {.kind = CommandKind::Override,
                                                   .feed_percent = options.feed_percent,
                                                   .rapid_percent = options.rapid_percent});
        if (!reply) { return output.fail(reply.error()); }
        if (reply->status == ReplyStatus::Refused) { return print_refusal(*reply, output); }
    }
    proto::CommandReport report;
    report.set_accepted(true);
    report.set_text(text_of(overrides));
    output.report(report);
    output.print("override: " + report.text());
    return kExitDone;
}

}  // namespace

void add_override(Verb command) {
    const Verb verb =
        command.add_verb("override",
                         "change feed and rapid, in percent of the programmed values\n"
                         "It also works while a job runs: the machine stays on its path and within every limit. "
                         "The percentages apply until the next change, also to later jobs. Without --feed and "
                         "--rapid, the command prints them. They do not apply to homing, to jog and to move "
                         "--own.");
    const auto options = std::make_shared<OverrideOptions>();
    verb.add_option("--feed", options->feed_percent, "percent of the programmed feeds")
        .in_range(Overrides::kLeast, Overrides::kMost);
    verb.add_option("--rapid", options->rapid_percent,
                    "percent of the greatest speed that the axes allow; more than 100 counts as 100")
        .in_range(Overrides::kLeast, Overrides::kMost);
    add_take(verb, *options);
    add_live_options(verb, *options);
    verb.footer(footer("  lockstep override --feed 60\n  lockstep override --feed 100 --rapid 25\n"));
    verb.action([options] { return turn(*options); });
}

}  // namespace lockstep
