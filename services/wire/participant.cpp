#include "services/wire/participant.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "services/wire/dds_log.hpp"
#include "services/wire/interface_sockets.hpp"
#include "services/wire/partitions.hpp"
#include "services/wire/peer_discovery.hpp"
#include "services/wire/protocol_version.hpp"
#include "services/wire/security_properties.hpp"

namespace lockstep {
namespace {

constexpr const char* kAddedProfile = "CYCLONEDDS_URI";

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

// Why: a lost setpoint must be asked for at once (NackDelay 0; the default 100 ms would cost ten slots), a lost last
// one must be noticed soon (heartbeats of 2 to 20 ms), and a process that starts or dies must be seen within a second.
constexpr const char* kByMulticast =
    "<Discovery><SPDPInterval>200 ms</SPDPInterval><LeaseDuration>1 s</LeaseDuration></Discovery>";
constexpr const char* kTuning =
    "<Internal><HeartbeatInterval min=\"1 ms\" minsched=\"1 ms\" max=\"20 ms\">2 ms</HeartbeatInterval>"
    "<NackDelay>0 ms</NackDelay><AckDelay>1 ms</AckDelay><PreEmptiveAckDelay>1 ms</PreEmptiveAckDelay>"
    "<AutoReschedNackDelay>2 ms</AutoReschedNackDelay></Internal>";

// To the sink of dds_log.hpp, and to no file.
constexpr const char* kTrace = "<Tracing><Category>discovery</Category><OutputFile>/dev/null</OutputFile></Tracing>";

bool is_interface_name(const std::string& name) {
    const auto allowed = [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == '@';
    };
    return !name.empty() && std::ranges::all_of(name, allowed);
}

std::string place(const NetworkConfig& network) {
    return "DDS domain " + std::to_string(network.domain) + " on interface " + network.interface;
}

std::string cannot_open(const NetworkConfig& network, const char* why) {
    return "cannot open " + place(network) + ": " + why +
           "; check that the interface exists and has an address (ip addr show " + network.interface +
           "), that the domain is 0 to 230, and CYCLONEDDS_URI if it is set";
}

std::string cannot_join(const NetworkConfig& network, const Membership& membership, const Entity& participant) {
    if (!membership.credentials) { return cannot_open(network, participant.why_not()); }
    return "DDS Security does not let this process into " + place(network) + " by " +
           membership.credentials->certificate.string() + ": " + participant.why_not() +
           "; see what DDS said before, and: lockstep keys check";
}

std::expected<void, std::string> create_domain(const NetworkConfig& network, bool is_secured) {
    const bool is_added_to = std::getenv(kAddedProfile) != nullptr;
    const bool watches = is_secured && !is_added_to;  // a trace that somebody asks for is his
    const auto profile = dds_profile(network, watches ? Discovery::Traced : Discovery::Quiet);
    if (!profile) { return std::unexpected(profile.error()); }
    if (watches) { watch_newcomers(); }
    const Descriptors before = udp_sockets();
    const dds_entity_t domain = dds_create_domain(network.domain, profile->c_str());
    if (domain < 0) { return std::unexpected(cannot_open(network, dds_strretcode(domain))); }
    if (is_added_to) { return {}; }  // it may name further interfaces
    return tie_new_sockets(before, network.interface);
}

/// A domain is the process's: it is made once, by the first participant, and lives until the process ends.
std::expected<void, std::string> ensure_domain(const NetworkConfig& network, bool is_secured) {
    static std::mutex mutex;
    static std::map<std::uint32_t, std::string> interface_of;
    const std::lock_guard lock(mutex);
    const auto known = interface_of.find(network.domain);
    if (known == interface_of.end()) {
        auto created = create_domain(network, is_secured);
        if (created) { interface_of[network.domain] = network.interface; }
        return created;
    }
    if (known->second == network.interface) { return {}; }
    return std::unexpected("cannot open " + place(network) + ": this process has that domain on interface " +
                           known->second + "; use another domain");
}

Qos partition_qos(const std::vector<std::string>& partitions) {
    Qos qos{dds_create_qos(), &dds_delete_qos};
    std::vector<const char*> names;
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

std::expected<std::string, std::string> dds_profile(const NetworkConfig& network, Discovery told) {
    if (!is_interface_name(network.interface)) {
        return std::unexpected("'" + network.interface + "' is not a network interface's name; see: ip link");
    }
    // lo does not say that it can multicast, but it can; a real interface says it itself.
    const std::string multicast = network.interface == "lo" ? "true" : "default";
    std::string profile = "<CycloneDDS><Domain id=\"any\"><General><Interfaces><NetworkInterface name=\"" +
                          network.interface + "\" multicast=\"" + multicast + "\"/></Interfaces></General>" +
                          (network.peers.empty() ? kByMulticast : peer_discovery(network.peers)) + kTuning +
                          (told == Discovery::Traced ? kTrace : "") + "</Domain></CycloneDDS>";
    const char* added = std::getenv(kAddedProfile);
    return added == nullptr ? profile : profile + "," + added;
}

std::expected<Participant, std::string> Participant::open(const NetworkConfig& network, const std::string& machine,
                                                          const Membership& membership) {
    if (machine.empty() || machine.find_first_of("*?[]") != machine.npos) {  // DDS would match them as patterns
        return std::unexpected("'" + machine + "' cannot name a machine: it is empty or has one of * ? [ ]");
    }
    if (auto domain = ensure_domain(network, membership.credentials.has_value()); !domain) {
        return std::unexpected(domain.error());
    }
    Participant made;
    made.machine_ = machine;
    made.participant_ =
        Entity(dds_create_participant(network.domain, participant_qos(machine, membership).get(), nullptr));
    if (!made.participant_.good()) { return std::unexpected(cannot_join(network, membership, made.participant_)); }
    note_joined();
    watch_versions(made.handle(), machine);
    const Qos written = partition_qos({partition_of(machine, membership.axis)});
    const Qos heard = partition_qos(heard_partitions(machine));
    made.publisher_ = Entity(dds_create_publisher(made.handle(), written.get(), nullptr));
    made.subscriber_ = Entity(dds_create_subscriber(made.handle(), heard.get(), nullptr));
    if (!made.publisher_.good()) { return std::unexpected(cannot_open(network, made.publisher_.why_not())); }
    if (!made.subscriber_.good()) { return std::unexpected(cannot_open(network, made.subscriber_.why_not())); }
    return made;
}

void Participant::note_failure(std::string text) {
    if (!failure_) { failure_ = std::move(text); }
}

}  // namespace lockstep
