#include "services/security/service_admission.hpp"

#include "services/runtime/log.hpp"
#include "services/security/admission.hpp"
#include "services/wire/dds/dds_log.hpp"

namespace lockstep {

std::expected<Membership, std::string> admit_service(const MachineConfig& machine, const Member& member) {
    forward_dds_log([](const std::string& text) { log_warning("DDS: " + text); });
    auto admission = admit(machine, member);
    if (!admission) { return std::unexpected(admission.error()); }
    for (const std::string& warning : admission->warnings) { log_warning(warning); }
    if (machine.security.enabled()) { log_info("joins as " + member.name + ", with DDS Security"); }
    return admission->membership;
}

void log_unauthenticated_peers(std::chrono::nanoseconds now) {
    for (const std::string& text : unauthenticated_peers(now)) { log_warning("DDS: " + text); }
}

}  // namespace lockstep
