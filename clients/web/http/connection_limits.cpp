#include "clients/web/http/connection_limits.hpp"

#include <algorithm>
#include <utility>

namespace lockstep::web {

void ConnectionLimits::begin(Id connection, const std::string& peer, Time now) {
    const std::lock_guard lock(mutex_);
    entries_[connection] = {.number = ++last_number_, .peer = peer, .until = now + kPatience};
    keep_bound_of_unknown();
}

void ConnectionLimits::wait(Id connection, Waits what, std::size_t bytes, Time now) {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(connection);
    if (found == entries_.end()) { return; }
    Entry& entry = found->second;
    const bool is_idle = what == Waits::ForHead && entry.is_signed_in;
    entry.waits = what;
    entry.until = now + (is_idle ? kIdle : kPatience) + std::chrono::seconds(bytes / kLeastRate_bytes_s);
}

void ConnectionLimits::sign_in(Id connection) {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(connection);
    if (found == entries_.end() || found->second.is_signed_in) { return; }
    found->second.is_signed_in = true;
    keep_bound_of_signed_in(connection);
}

void ConnectionLimits::forget(Id connection) {
    const std::lock_guard lock(mutex_);
    entries_.erase(connection);
}

void ConnectionLimits::close_late(Time now) {
    const std::lock_guard lock(mutex_);
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
        if (entry->second.waits != Waits::ForServer && now >= entry->second.until) { close(entry); }
    }
}

void ConnectionLimits::close(Entries::iterator entry) {
    if (entry->second.is_closing) { return; }
    entry->second.is_closing = true;
    close_(entry->first);
}

void ConnectionLimits::keep_bound_of_unknown() {
    struct Of {
        std::size_t count = 0;
        Entries::iterator oldest;
    };
    std::map<std::string, Of> by_peer;
    std::size_t all = 0;
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
        if (entry->second.is_signed_in || entry->second.is_closing) { continue; }
        Of& of = by_peer.try_emplace(entry->second.peer, Of{0, entry}).first->second;
        if (entry->second.number < of.oldest->second.number) { of.oldest = entry; }
        ++of.count;
        ++all;
    }
    const auto most = std::ranges::max_element(
        by_peer, {}, [](const auto& one) { return std::pair(one.second.count, ~one.second.oldest->second.number); });
    if (most != by_peer.end() && (all > kMostUnknown || most->second.count > kMostUnknownOfAddress)) {
        close(most->second.oldest);
    }
}

/// Closes the oldest of those that wait for a head; if there are none, of those that wait for a body, and so on.
void ConnectionLimits::keep_bound_of_signed_in(Id newest) {
    const auto rank = [](const Entry& entry) { return std::pair(entry.waits, entry.number); };
    std::size_t all = 0;
    auto first = entries_.end();
    for (auto entry = entries_.begin(); entry != entries_.end(); ++entry) {
        if (!entry->second.is_signed_in || entry->second.is_closing) { continue; }
        ++all;
        if (entry->first == newest) { continue; }
        if (first == entries_.end() || rank(entry->second) < rank(first->second)) { first = entry; }
    }
    if (all > kMostSignedIn) { close(first); }
}

}  // namespace lockstep::web
