#include "clients/scenario/runner/network.hpp"

#include <fmt/format.h>

#include "core/number_text.hpp"

namespace lockstep::scenario {
namespace {

constexpr const char* kBridge = "eth0";  // the same in every namespace, because the machine's file names one interface
constexpr const char* kMtu = "65535";    // no fragmented datagrams: a firewall sees the port only in the first fragment
constexpr const char* kRecordPort = "7667";
constexpr const char* kMulticast = "224.0.0.0/4";

CommandLine joined(CommandLine first, const CommandLine& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

}  // namespace

std::expected<Network, std::string> Network::make(Asked::Place place, const std::vector<std::string>& processes,
                                                  const std::filesystem::path& log) {
    Network network(log);
    if (const auto made = network.make_loopback(); !made) { return std::unexpected(made.error()); }
    if (!has_links(place)) {
        const auto routed = network.run_all({split_words(std::string("ip route add ") + kMulticast + " dev lo")});
        if (!routed) { return std::unexpected(routed.error()); }
        return network;
    }
    if (const auto made = network.make_bridge(); !made) { return std::unexpected(made.error()); }
    int number = 2;  // the bridge's own end is 1
    for (const std::string& process : processes) {
        if (process.starts_with("fpga-")) { continue; }  // reached through memory
        if (const auto added = network.add(process, number++); !added) { return std::unexpected(added.error()); }
    }
    return network;
}

std::expected<void, std::string> Network::make_loopback() {
    return run_all({split_words("ip link set lo up multicast on")});
}

std::expected<void, std::string> Network::make_bridge() {
    const std::string bridge = kBridge;
    return run_all({split_words("ip link add " + bridge + " type bridge mcast_snooping 0"),
                    split_words(fmt::format("ip link set {} mtu {} up", bridge, kMtu)),
                    split_words("ip addr add 10.9.0.1/24 dev " + bridge),
                    split_words(std::string("ip route add ") + kMulticast + " dev " + bridge)});
}

std::expected<void, std::string> Network::add(const std::string& process, int number) {
    const std::string bridge = kBridge;
    const std::string link = fmt::format("to-{}", number);
    const std::string on = "ip -n " + process + " ";
    namespaces_[process] = process;
    return run_all({split_words("ip netns add " + process),
                    split_words(fmt::format("ip link add {} type veth peer name {} netns {}", link, bridge, process)),
                    split_words(fmt::format("ip link set {} mtu {} master {} up", link, kMtu, bridge)),
                    split_words(on + "link set lo up"),
                    split_words(fmt::format("{}link set {} mtu {} up", on, bridge, kMtu)),
                    split_words(fmt::format("{}addr add 10.9.0.{}/24 dev {}", on, number, bridge)),
                    split_words(fmt::format("{}route add {} dev {}", on, kMulticast, bridge))});
}

std::expected<void, std::string> Network::run_all(const std::vector<CommandLine>& commands) const {
    for (const CommandLine& command : commands) {
        if (const auto ran = run_program(command, log_); !ran) { return ran; }
    }
    return {};
}

std::string Network::namespace_of(const std::string& process) const {
    const auto found = namespaces_.find(process);
    return found == namespaces_.end() ? "" : found->second;
}

CommandLine Network::entry(const std::string& process) const {
    const std::string name = namespace_of(process);
    if (name.empty()) { return {}; }
    return {"nsenter", "--net=/run/netns/" + name};
}

std::expected<void, std::string> Network::lose(const std::string& process, double percent, Asked::Way way) {
    const bool all = percent >= 100;
    const std::string chance = all ? "" : " -m statistic --mode random --probability " + number_text(percent / 100);
    std::vector<CommandLine> commands;
    for (const bool inbound : {true, false}) {
        if (way == (inbound ? Asked::SAYS : Asked::HEARS)) { continue; }
        const std::string chain = inbound ? "INPUT -i " : "OUTPUT -o ";
        commands.push_back(
            joined(entry(process), split_words(fmt::format("iptables -w -A {}{} -p udp ! --dport {}{} -j DROP", chain,
                                                           kBridge, kRecordPort, chance))));
    }
    return run_all(commands);
}

std::expected<void, std::string> Network::heal(const std::string& process) {
    return run_all({joined(entry(process), split_words("iptables -w -F"))});
}

std::expected<void, std::string> Network::heal_all() {
    for (const std::string& process : linked()) {
        if (const auto healed = heal(process); !healed) { return healed; }
    }
    return {};
}

std::vector<std::string> Network::linked() const {
    std::vector<std::string> names;
    for (const auto& [process, name] : namespaces_) { names.push_back(process); }
    return names;
}

}  // namespace lockstep::scenario
