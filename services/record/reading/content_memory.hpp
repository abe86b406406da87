// Remembers the content of the newest messages of a process, as hashes, to tell a repeat from a contradiction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>

namespace lockstep::analysis {

/// Mixes numbers into one (FNV-1a, over words instead of bytes).
class ContentHash {
public:
    ContentHash& add(std::int64_t number) {
        hash_ = (hash_ ^ static_cast<std::uint64_t>(number)) * 0x100000001B3;
        hash_ ^= hash_ >> 29;
        return *this;
    }
    std::size_t value() const { return hash_; }

private:
    std::uint64_t hash_ = 0xCBF29CE484222325;
};

class ContentMemory {
public:
    static constexpr std::size_t kKept = 4096;             // messages
    using Number = std::pair<std::int64_t, std::int64_t>;  // the process and the number of its message

    void add(Number number, std::size_t content) {
        if (!contents_.try_emplace(number, content).second) { return; }
        order_.push_back(number);
        if (order_.size() <= kKept) { return; }
        contents_.erase(order_.front());
        order_.pop_front();
    }
    /// The content of the first message with that number; nullopt if there was none, or if it is not remembered.
    std::optional<std::size_t> find(Number number) const {
        const auto found = contents_.find(number);
        return found == contents_.end() ? std::nullopt : std::optional(found->second);
    }

private:
    std::map<Number, std::size_t> contents_;
    std::deque<Number> order_;
};

}  // namespace lockstep::analysis
