// The recently written messages, by time and content: distinguishes a repeated message from a new one.
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string_view>
#include <utility>

#include "clients/merge/merge_input.hpp"

namespace lockstep::merge {

class WrittenLately {
public:
    explicit WrittenLately(std::int64_t span_us) : span_us_(span_us) {}

    /// Returns false if the message is a repeat.
    bool add(const HeldMessage& message) {
        written_.erase(written_.begin(), written_.lower_bound({message.id.utime - span_us_, 0}));
        return written_.emplace(message.id.utime, hash_of(message)).second;
    }
    bool has(const HeldMessage& message) const { return written_.contains({message.id.utime, hash_of(message)}); }

private:
    static std::size_t hash_of(const HeldMessage& message) {
        const std::string_view data(reinterpret_cast<const char*>(message.data.data()), message.data.size());
        constexpr std::size_t kOdd = 0x9E3779B97F4A7C15;
        return std::hash<std::string_view>{}(data)*kOdd + std::hash<std::string_view>{}(message.id.channel);
    }

    std::int64_t span_us_;
    std::set<std::pair<std::int64_t, std::size_t>> written_;
};

}  // namespace lockstep::merge
