// Finds the changes of one process's inputs and outputs that a record lacks between others, with the time of the gap.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lockstep::merge {

/// Changes of inputs and outputs that no log contains, published between two others. Microseconds of machine time;
/// from_us is nullopt if the log lacks the first changes of a process.
struct MissingChanges {
    std::string axis;
    std::int64_t messages = 0;
    std::optional<std::int64_t> from_us;
    std::int64_t to_us = 0;
};

class ChannelGaps {
public:
    /// Call it once for each number, in any order. `lost`: changes that the device has lost so far.
    void take(std::int64_t number, std::int64_t utime, std::int64_t lost);
    /// In the order of their numbers.
    std::vector<MissingChanges> gaps() const;
    /// Changes that the device lost between the first and the last message.
    std::int64_t lost_by_device() const { return most_lost_.value_or(0) - least_lost_.value_or(0); }

private:
    /// Numbers without a gap.
    struct Sequence {
        std::int64_t end = 0;
        std::int64_t first_us = 0;
        std::int64_t last_us = 0;
    };
    std::map<std::int64_t, Sequence> sequences_;  // by their first number
    std::optional<std::int64_t> least_lost_;
    std::optional<std::int64_t> most_lost_;
};

}  // namespace lockstep::merge
