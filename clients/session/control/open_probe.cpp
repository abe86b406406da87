#include "clients/session/control/open_probe.hpp"

#include <string>

#include "clients/session/reports.hpp"

namespace lockstep {

std::expected<void, Failure> check_open(const Session& session, int probe) {
    const proto::StatusReport status = status_report(session);
    for (const proto::InputStatus& input : status.inputs()) {
        const bool is_probe = input.use() == name_of(InputUse::Probe) && static_cast<int>(input.number()) == probe;
        if (!is_probe || !input.closed()) { continue; }
        return std::unexpected(failed("probe " + std::to_string(probe) + " touches already (input " + input.name() +
                                      "); move it off what it touches, or check its wire"));
    }
    return {};
}

}  // namespace lockstep
