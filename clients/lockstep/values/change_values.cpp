#include "clients/lockstep/values/change_values.hpp"

#include "clients/session/session.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/output.hpp"
#include "idl/proto/values.pb.h"

namespace lockstep {
namespace {

std::expected<Session, Failure> open(const LiveOptions& options, Purpose purpose) {
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return std::unexpected(machine.error()); }
    return Session::open(*machine, purpose);
}

/// A program that has nothing to run.
Program edit_of(const MachineConfig& machine) {
    Program program{.name = "edit", .axes = {}, .start_mm = std::vector<double>(machine.axes.size()), .blocks = {}};
    for (const AxisConfig& axis : machine.axes) { program.axes.push_back(axis.name); }
    return program;
}

/// The values before become `values`.
std::expected<void, Failure> store(Session& session, RevisedValues& values, const gcode::KeptValues& wanted) {
    if (wanted == values.values) { return {}; }
    const gcode::ProgramValues edit{.revision = values.revision, .after = wanted, .at_once = true};
    if (const auto sent = session.send(edit_of(session.config()), nullptr, edit); !sent) {
        return std::unexpected(sent.error());
    }
    values = {values.revision + 1, wanted};
    return session.await_kept(values.revision);
}

ExitCode print(const Session& session, const RevisedValues& values, ValuesText text, Output& output) {
    output.report(values_to_proto(values));
    output.print(text(session.config(), values.values));
    return kExitDone;
}

}  // namespace

ExitCode show_values(const LiveOptions& options, ValuesText text) {
    Output output(options.json);
    auto session = open(options, Purpose::Look);
    if (!session) { return output.fail(session.error()); }
    const auto values = session->values();
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
    auto values = session->values();
    if (!values) { return output.fail(values.error()); }
    gcode::KeptValues wanted = values->values;
    if (const auto changed = change(*session, wanted); !changed) { return output.fail(bad_input(changed.error())); }
    if (const auto stored = store(*session, *values, wanted); !stored) { return output.fail(stored.error()); }
    return print(*session, *values, text, output);
}

}  // namespace lockstep
