#include "services/wire/participant.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <memory>
#include <mutex>

namespace lockstep {
namespace {

constexpr int kProcessesOfHost = 16;  // that find each other without multicast: each asks as many ports of every peer

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

// Why: a lost setpoint must be asked for at once (NackDelay 0; the default 100 ms would cost ten slots), a lost last
// one must be noticed soon (heartbeats of 2 to 20 ms), and a process that starts or dies must be seen within a second.
constexpr const char* kSoon = "<SPDPInterval>200 ms</SPDPInterval><LeaseDuration>1 s</LeaseDuration>";
constexpr const char* kTuning =
    "<Internal><HeartbeatInterval min=\"1 ms\" minsched=\"1 ms\" max=\"20 ms\">2 ms</HeartbeatInterval>"
    "<NackDelay>0 ms</NackDelay><AckDelay>1 ms</AckDelay><PreEmptiveAckDelay>1 ms</PreEmptiveAckDelay>"
    "<AutoReschedNackDelay>2 ms</AutoReschedNackDelay></Internal>";

bool is_interface_name(const std::string& name) {
    const auto allowed = [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == '@';
    };
    return !name.empty() && std::ranges::all_of(name, allowed);
}

/// How processes find each other. Without multicast each asks every peer, on the ports that DDS gives to one process of
/// a host after the other.
std::string discovery(const std::vector<std::string>& peers) {
    if (peers.empty()) { return std::string("<Discovery>") + kSoon + "</Discovery>"; }
    std::string listed;
    for (const std::string& peer : peers) { listed += "<Peer address=\"" + peer + "\"/>"; }
    return "<General><AllowMulticast>false</AllowMulticast></General><Discovery>" + std::string(kSoon) +
           "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>" + std::to_string(kProcessesOfHost - 1) +
           "</MaxAutoParticipantIndex><Peers>" + listed + "</Peers></Discovery>";
}

std::string place(const NetworkConfig& network) {
    return "DDS domain " + std::to_string(network.domain) + " on interface " + network.interface;
}

std::string cannot_open(const NetworkConfig& network, const char* why) {
    return "cannot open " + place(network) + ": " + why +
           "; check that the interface exists and has an address (ip addr show " + network.interface +
           "), that the domain is 0 to 230, and CYCLONEDDS_URI if it is set";
}

std::expected<void, std::string> create_domain(const NetworkConfig& network) {
    const auto profile = dds_profile(network);
    if (!profile) { return std::unexpected(profile.error()); }
    const dds_entity_t domain = dds_create_domain(network.domain, profile->c_str());
    if (domain < 0) { return std::unexpected(cannot_open(network, dds_strretcode(domain))); }
    return {};
}

/// A domain is the process's: it is made once, by the first participant, and lives until the process ends.
std::expected<void, std::string> ensure_domain(const NetworkConfig& network) {
    static std::mutex mutex;
    static std::map<std::uint32_t, std::string> interface_of;
    const std::lock_guard lock(mutex);
    const auto known = interface_of.find(network.domain);
    if (known == interface_of.end()) {
        auto created = create_domain(network);
        if (created) { interface_of[network.domain] = network.interface; }
        return created;
    }
    if (known->second == network.interface) { return {}; }
    return std::unexpected("cannot open " + place(network) + ": this process has that domain on interface " +
                           known->second + "; use another domain");
}

Qos partition_qos(const std::string& machine) {
    Qos qos{dds_create_qos(), &dds_delete_qos};
    dds_qset_partition1(qos.get(), machine.c_str());
    return qos;
}

}  // namespace

std::expected<std::string, std::string> dds_profile(const NetworkConfig& network) {
    if (!is_interface_name(network.interface)) {
        return std::unexpected("'" + network.interface + "' is not a network interface's name; see: ip link");
    }
    // lo does not say that it can multicast, but it can; a real interface says it itself.
    const std::string multicast = network.interface == "lo" ? "true" : "default";
    std::string profile = "<CycloneDDS><Domain id=\"any\"><General><Interfaces><NetworkInterface name=\"" +
                          network.interface + "\" multicast=\"" + multicast + "\"/></Interfaces></General>" +
                          discovery(network.peers) + kTuning + "</Domain></CycloneDDS>";
    const char* added = std::getenv("CYCLONEDDS_URI");
    return added == nullptr ? profile : profile + "," + added;
}

std::expected<Participant, std::string> Participant::open(const NetworkConfig& network, const std::string& machine) {
    if (machine.empty() || machine.find_first_of("*?[]") != machine.npos) {  // DDS would match them as patterns
        return std::unexpected("'" + machine + "' cannot name a machine: it is empty or has one of * ? [ ]");
    }
    if (auto domain = ensure_domain(network); !domain) { return std::unexpected(domain.error()); }
    const Qos partition = partition_qos(machine);
    Participant made;
    made.participant_ = Entity(dds_create_participant(network.domain, nullptr, nullptr));
    if (!made.participant_.good()) { return std::unexpected(cannot_open(network, made.participant_.why_not())); }
    made.publisher_ = Entity(dds_create_publisher(made.handle(), partition.get(), nullptr));
    made.subscriber_ = Entity(dds_create_subscriber(made.handle(), partition.get(), nullptr));
    if (!made.publisher_.good()) { return std::unexpected(cannot_open(network, made.publisher_.why_not())); }
    if (!made.subscriber_.good()) { return std::unexpected(cannot_open(network, made.subscriber_.why_not())); }
    return made;
}

void Participant::note_failure(std::string text) {
    if (!failure_) { failure_ = std::move(text); }
}

}  // namespace lockstep
