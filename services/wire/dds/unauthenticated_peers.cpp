#include "services/wire/dds/unauthenticated_peers.hpp"

namespace lockstep {
namespace {

/// Returns the text between `before` and the next character of `ends`; empty if the line does not contain `before`.
std::string_view after(std::string_view line, std::string_view before, std::string_view ends) {
    const std::size_t at = line.find(before);
    if (at == line.npos) { return {}; }
    line.remove_prefix(at + before.size());
    return line.substr(0, line.find_first_of(ends));
}

std::string described(std::string_view peer, std::string_view address) {
    return "participant " + std::string(peer) + (address.empty() ? "" : " at " + std::string(address));
}

}  // namespace

std::optional<std::string> UnauthenticatedPeers::note_line(std::chrono::nanoseconds now, std::string_view line) {
    line = line.substr(0, line.find('{'));  // the rest is the peer's own description
    if (line.find(" succeeded") != line.npos) { pending_.erase(std::string(after(line, "rguid=", ") "))); }
    if (line.find(" delete") != line.npos) { pending_.erase(std::string(after(line, "SPDP ST3 ", " "))); }
    const std::string peer(after(line, "SPDP ST0 ", " "));
    if (peer.empty() || line.find(" NEW") == line.npos) { return std::nullopt; }
    const std::string address(after(line, "meta ", " )"));
    if (line.find("(secure)") == line.npos) { return described(peer, address) + " has no certificate and is excluded"; }
    if (pending_.size() < kMaxPending) { pending_.try_emplace(peer, now, address); }
    return std::nullopt;
}

std::vector<std::string> UnauthenticatedPeers::due(std::chrono::nanoseconds now) {
    std::vector<std::string> texts;
    std::erase_if(pending_, [&](const auto& entry) {
        const bool due = now - entry.second.joined >= kPatience;
        if (due) {
            texts.push_back(described(entry.first, entry.second.address) + " did not authenticate and is excluded");
        }
        return due;
    });
    return texts;
}

}  // namespace lockstep
