#include "services/wire/dds/domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iterator>
#include <map>
#include <mutex>

#include "services/runtime/heap.hpp"
#include "services/wire/dds/dds_log.hpp"
#include "services/wire/dds/dds_pace.hpp"
#include "services/wire/dds/peer_discovery.hpp"

namespace lockstep {
namespace {

constexpr const char* kAddedProfile = "CYCLONEDDS_URI";

// Messages that wait for delivery stay in receive buffers, and DDS fills each buffer before it reuses it. With the
// default of 1 MiB it takes thousands of clients to fill a buffer once, and until then the growth looks like a leak.
constexpr const char* kReceiveBuffers = "<Sizing><ReceiveBufferSize>256 KiB</ReceiveBufferSize></Sizing>";

// Traces discovery to the sink of dds_log.hpp, not to a file.
constexpr const char* kTrace = "<Tracing><Category>discovery</Category><OutputFile>/dev/null</OutputFile></Tracing>";

bool is_interface_name(const std::string& name) {
    const auto allowed = [](unsigned char c) {
        return std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == '@';
    };
    return !name.empty() && std::ranges::all_of(name, allowed);
}

}  // namespace

std::chrono::nanoseconds lease_of(const NetworkConfig& network) {
    return network.peers.empty() ? discovery_lease(network.processes) : kPeerLease;
}

std::string domain_place(const NetworkConfig& network) {
    return fmt::format("DDS domain {} on interface {}", network.domain, network.interface);
}

std::string cannot_open_domain(const NetworkConfig& network, const char* why) {
    return "cannot open " + domain_place(network) + ": " + why +
           "; check that the interface exists and has an address (ip addr show " + network.interface +
           "), that the domain is 0 to 232, and CYCLONEDDS_URI if it is set";
}

std::expected<std::string, std::string> dds_profile(const NetworkConfig& network, Discovery discovery) {
    if (!is_interface_name(network.interface)) {
        return std::unexpected("'" + network.interface + "' is not a network interface's name; see: ip link");
    }
    // lo supports multicast but does not announce it. A real interface announces it.
    const std::string multicast = network.interface == "lo" ? "true" : "default";
    const std::string by_multicast = "<Discovery>" + discovery_pace(network.processes) + "</Discovery>";
    std::string profile = "<CycloneDDS><Domain id=\"any\"><General><Interfaces><NetworkInterface name=\"" +
                          network.interface + "\" multicast=\"" + multicast + "\"/></Interfaces></General>" +
                          (network.peers.empty() ? by_multicast : peer_discovery(network.peers)) + "<Internal>" +
                          repair_pace(network.processes) + "</Internal>" + kReceiveBuffers +
                          (discovery == Discovery::Traced ? kTrace : "") + "</Domain></CycloneDDS>";
    if (const char* added = std::getenv(kAddedProfile)) { profile += std::string(",") + added; }
    return profile;
}

std::expected<std::shared_ptr<const Domain>, std::string> Domain::make(const NetworkConfig& network, bool is_secured) {
    const bool is_added_to = std::getenv(kAddedProfile) != nullptr;
    const bool watches = is_secured && !is_added_to;  // keeps a trace that the environment requests
    const auto profile = dds_profile(network, watches ? Discovery::Traced : Discovery::Quiet);
    if (!profile) { return std::unexpected(profile.error()); }
    if (watches) { watch_unauthenticated_peers(); }
    give_back_large_blocks();
    const Descriptors before = udp_sockets();
    Entity entity(dds_create_domain(network.domain, profile->c_str()));
    if (!entity.good()) { return std::unexpected(cannot_open_domain(network, entity.why_not())); }
    Descriptors sockets;
    std::ranges::set_difference(udp_sockets(), before, std::inserter(sockets, sockets.end()));
    std::shared_ptr<const Domain> made(new Domain(network.interface, std::move(entity), std::move(sockets)));
    if (is_added_to) { return made; }  // CYCLONEDDS_URI may name further interfaces
    if (auto tied = tie_new_sockets(before, network.interface); !tied) { return std::unexpected(tied.error()); }
    return made;
}

std::expected<std::shared_ptr<const Domain>, std::string> Domain::join(const NetworkConfig& network, bool is_secured) {
    static std::mutex mutex;
    static std::map<std::uint32_t, std::weak_ptr<const Domain>> domains;
    const std::lock_guard lock(mutex);
    auto known = domains[network.domain].lock();
    if (!known) {
        auto made = make(network, is_secured);
        if (made) { domains[network.domain] = *made; }
        return made;
    }
    if (known->interface_ == network.interface) { return known; }
    return std::unexpected("cannot open " + domain_place(network) + ": this process has that domain on interface " +
                           known->interface_ + "; use another domain");
}

}  // namespace lockstep
