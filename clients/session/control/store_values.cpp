#include "clients/session/control/store_values.hpp"

#include "clients/session/waits.hpp"

namespace lockstep {

Program edit_of(const MachineConfig& machine) {
    return {.name = "edit",
            .axes = machine.axis_names(),
            .start_mm = std::vector<double>(machine.axes.size()),
            .blocks = {}};
}

std::expected<void, Failure> store_values(Session& session, RevisedValues& values, const gcode::KeptValues& wanted) {
    if (wanted == values.values) { return {}; }
    const gcode::ProgramValues edit{.revision = values.revision, .after = wanted, .at_once = true};
    if (const auto sent = send_program(session, edit_of(session.config()), nullptr, edit); !sent) {
        return std::unexpected(sent.error());
    }
    values = {values.revision + 1, wanted};
    return await_kept(session, values.revision);
}

}  // namespace lockstep
