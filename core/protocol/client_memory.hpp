// What is remembered of each client, for commands that come again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "core/protocol/messages.hpp"

namespace lockstep {

/// One value for each of the newest kClients clients: the one noted the longest ago gives way to a new one.
template <typename T>
class ClientMemory {
public:
    static constexpr std::size_t kClients = 32;

    ClientMemory() { notes_.reserve(kClients); }

    /// The value noted last for this client; null: none, or forgotten.
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
