#include "services/wire/dds/newcomers.hpp"

namespace lockstep {
namespace {

/// What stands between `before` and the next of `ends`; empty: `before` is not there.
std::string_view after(std::string_view line, std::string_view before, std::string_view ends) {
    const std::size_t at = line.find(before);
    if (at == line.npos) { return {}; }
    line.remove_prefix(at + before.size());
    return line.substr(0, line.find_first_of(ends));
}

std::string described(std::string_view who, std::string_view address) {
    return "participant " + std::string(who) + (address.empty() ? "" : " at " + std::string(address));
}

}  // namespace

std::optional<std::string> Newcomers::hear(std::chrono::nanoseconds now, std::string_view line) {
    line = line.substr(0, line.find('{'));  // behind it stands what the newcomer says of itself
    if (line.find(" succeeded") != line.npos) { pending_.erase(std::string(after(line, "rguid=", ") "))); }
    if (line.find(" delete") != line.npos) { pending_.erase(std::string(after(line, "SPDP ST3 ", " "))); }
    const std::string who(after(line, "SPDP ST0 ", " "));
    if (who.empty() || line.find(" NEW") == line.npos) { return std::nullopt; }
    const std::string address(after(line, "meta ", " )"));
    if (line.find("(secure)") == line.npos) { return described(who, address) + " has no certificate and is shut out"; }
    if (pending_.size() < kMaxPending) { pending_.try_emplace(who, now, address); }
    return std::nullopt;
}

std::vector<std::string> Newcomers::unproved(std::chrono::nanoseconds now) {
    std::vector<std::string> said;
    std::erase_if(pending_, [&](const auto& entry) {
        const bool due = now - entry.second.came >= kPatience;
        if (due) {
            said.push_back(described(entry.first, entry.second.address) +
                           " has not proved to belong to this machine and is shut out");
        }
        return due;
    });
    return said;
}

}  // namespace lockstep
