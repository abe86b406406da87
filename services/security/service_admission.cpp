#include "services/security/service_admission.hpp"

#include "services/runtime/log.hpp"
#include "services/security/admission.hpp"
#include "services/security/expiry_watch.hpp"
#include "services/wire/dds/dds_log.hpp"

namespace lockstep {
namespace {

std::optional<ExpiryWatch> own_expiry;  // of this process, which joins once

}  // namespace

std::expected<Membership, std::string> admit_service(const MachineSetup& machine, const Member& member) {
    forward_dds_log([](const std::string& text) { log_warning("DDS: " + text); });
    auto admission = admit(machine, member);
    if (!admission) { return std::unexpected(admission.error()); }
    if (admission->until) { own_expiry.emplace(member.name, *admission->until); }
    if (machine.security.enabled()) { log_info("joins as " + member.name + ", with DDS Security"); }
    return admission->membership;
}

void log_security(std::chrono::nanoseconds now) {
    for (const std::string& text : unauthenticated_peers(now)) { log_warning("DDS: " + text); }
    if (!own_expiry) { return; }
    const auto wall = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    if (const auto text = own_expiry->due(wall)) { log_warning(*text); }
}

}  // namespace lockstep
