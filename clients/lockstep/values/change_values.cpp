#include "clients/lockstep/values/change_values.hpp"

#include "clients/session/control/lease_turn.hpp"
#include "clients/session/control/store_values.hpp"
#include "clients/session/refusal.hpp"
#include "clients/session/session.hpp"
#include "clients/session/waits.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/format.hpp"
#include "clients/text/output.hpp"
#include "idl/proto/values.pb.h"
#include "services/documents/values/values_trouble.hpp"

namespace lockstep {
namespace {

std::expected<Session, Failure> open(const LiveOptions& options, Purpose purpose) {
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return std::unexpected(machine.error()); }
    return Session::open(*machine, purpose);
}

/// The rest of a paused program is in machine coordinates already.
void note_paused_job(const Session& session, Output& output) {
    if (!session.state() || !session.state()->state.pause) { return; }
    output.print(
        wrapped("the rest of the paused job does not use the new values: it goes to the places with which it "
                "was read. To run the rest with the new values: lockstep stop; lockstep run FILE --from-line "
                "LINE",
                80, ""));
}

ExitCode print(const Session& session, const RevisedValues& values, ValuesText text, Output& output) {
    std::vector<std::string> warnings;
    if (session.values().unsaved_since()) {
        warnings.push_back(std::string(kUnsavedValues) + "; " + kUnsavedValuesRemedy);
    }
    output.report(values_to_proto(values), warnings);
    output.print(text(session.config(), values.values));
    return kExitDone;
}

}  // namespace

ExitCode show_values(const LiveOptions& options, ValuesText text) {
    Output output(options.json);
    auto session = open(options, Purpose::Look);
    if (!session) { return output.fail(session.error()); }
    const auto values = await_values(*session);
    return values ? print(*session, *values, text, output) : output.fail(values.error());
}

ExitCode change_values(const LiveOptions& options, ValuesText text, const ChangeValues& change) {
    return change_values_here(options, text,
                              [&](Session& session, auto& values) { return change(session.config(), values); });
}

ExitCode change_values_here(const LiveOptions& options, ValuesText text, const ChangeHere& change) {
    Output output(options.json);
    auto session = open(options, Purpose::Command);
    if (!session) { return output.fail(session.error()); }
    auto values = await_values(*session);
    if (!values) { return output.fail(values.error()); }
    gcode::KeptValues wanted = values->values;
    if (const auto changed = change(*session, wanted); !changed) { return output.fail(bad_input(changed.error())); }
    const LeaseTurn turn(*session, options.take);
    if (!turn.answer()) { return output.fail(turn.answer().error()); }
    if (turn.is_refused()) { return print_refusal(*turn.answer(), output); }
    if (const auto stored = store_values(*session, *values, wanted); !stored) { return output.fail(stored.error()); }
    note_paused_job(*session, output);
    return print(*session, *values, text, output);
}

}  // namespace lockstep
