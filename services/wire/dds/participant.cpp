#include "services/wire/dds/participant.hpp"

#include <fmt/format.h>

#include <memory>
#include <vector>

#include "services/wire/dds/dds_log.hpp"
#include "services/wire/dds/partitions.hpp"
#include "services/wire/dds/protocol_version.hpp"
#include "services/wire/dds/security_properties.hpp"

namespace lockstep {
namespace {

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

std::string cannot_join(const NetworkConfig& network, const Membership& membership, const Entity& participant) {
    if (!membership.credentials) { return cannot_open_domain(network, participant.why_not()); }
    return fmt::format(
        "DDS Security does not allow this process to join {} by {}: {}; see the messages of DDS before this one, and: "
        "lockstep keys check",
        domain_place(network), membership.credentials->certificate.string(), participant.why_not());
}

Qos partition_qos(const std::vector<std::string>& partitions) {
    Qos qos{dds_create_qos(), &dds_delete_qos};
    std::vector<const char*> names;
    names.reserve(partitions.size());
    for (const std::string& partition : partitions) { names.push_back(partition.c_str()); }
    dds_qset_partition(qos.get(), static_cast<std::uint32_t>(names.size()), names.data());
    return qos;
}

Qos participant_qos(const std::string& machine, const Membership& membership) {
    Qos qos{dds_create_qos(), &dds_delete_qos};
    announce_version(*qos, kProtocol, machine);
    if (membership.credentials) { set_security(*qos, *membership.credentials); }
    return qos;
}

}  // namespace

std::expected<Participant, std::string> Participant::open(const NetworkConfig& network, const std::string& machine,
                                                          const Membership& membership) {
    if (machine.empty() || machine.find_first_of("*?[]") != machine.npos) {  // DDS would match them as patterns
        return std::unexpected("'" + machine + "' cannot name a machine: it is empty or has one of * ? [ ]");
    }
    const auto interface = interface_identity(network.interface);
    auto domain = Domain::join(network, membership.credentials.has_value());
    if (!domain) { return std::unexpected(domain.error()); }
    Participant made;
    made.domain_ = std::move(*domain);
    made.machine_ = machine;
    made.network_ = network;
    made.axis_ = membership.axis;
    made.interface_ = interface;
    made.participant_ =
        Entity(dds_create_participant(network.domain, participant_qos(machine, membership).get(), nullptr));
    if (!made.participant_.good()) { return std::unexpected(cannot_join(network, membership, made.participant_)); }
    note_joined();
    watch_versions(made.handle(), machine);
    const Qos written = partition_qos({partition_of(machine, membership.axis)});
    const Qos readable = partition_qos(read_partitions(machine));
    made.publisher_ = Entity(dds_create_publisher(made.handle(), written.get(), nullptr));
    made.subscriber_ = Entity(dds_create_subscriber(made.handle(), readable.get(), nullptr));
    if (!made.publisher_.good()) { return std::unexpected(cannot_open_domain(network, made.publisher_.why_not())); }
    if (!made.subscriber_.good()) { return std::unexpected(cannot_open_domain(network, made.subscriber_.why_not())); }
    if (membership.credentials) { made.sent_keys_ = std::make_unique<SentKeys>(made.handle(), made.subscriber()); }
    return made;
}

bool Participant::has_interface_changed() const {
    const auto now = interface_identity(network_.interface);
    return now && now != interface_;
}

void Participant::note_failure(std::string text) {
    if (!failure_) { failure_ = std::move(text); }
}

}  // namespace lockstep
