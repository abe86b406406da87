// Remembers one value for each client, to handle repeated commands.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/protocol/messages.hpp"

namespace lockstep {

/// One value for each of at most kClients clients. A new client replaces the one that was noted longest ago.
template <typename T>
class ClientMemory {
public:
    static constexpr std::size_t kClients = 32;

    ClientMemory() { notes_.reserve(kClients); }

    /// Returns the value noted last for this client, or null if there is none any more.
    const T* find(Identity client) const {
        const auto known = std::ranges::find(notes_, client, &Note::client);
        return known == notes_.end() ? nullptr : &known->value;
    }

    void note(Identity client, T value) {
        std::erase_if(notes_, [&](const Note& note) { return note.client == client; });
        if (notes_.size() == kClients) { notes_.erase(notes_.begin()); }
        notes_.push_back({client, std::move(value)});
    }

private:
    struct Note {
        Identity client;
        T value;
    };
    std::vector<Note> notes_;  // the oldest first
};

}  // namespace lockstep
