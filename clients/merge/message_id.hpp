// The identity of a message of the record, and its order among others.
#pragma once

#include <compare>
#include <cstdint>
#include <expected>
#include <optional>
#include <string>

#include "services/wire/lcm/lcm_log.hpp"

namespace lockstep::merge {

/// Messages of a channel are numbered without gaps from 0 on.
struct MessageNumber {
    std::int64_t incarnation = 0;  // of the axis's process, or the coordinator's
    std::int64_t sequence = 0;
    auto operator<=>(const MessageNumber&) const = default;
};

/// Orders messages by machine time, and those of the same microsecond by channel and number.
struct MessageId {
    std::int64_t utime = 0;  // microseconds of machine time
    std::string channel;
    std::optional<MessageNumber> number;
    auto operator<=>(const MessageId&) const = default;
};

/// Returns nullopt for a channel that is not part of the record. The error says why the message is impossible.
std::expected<std::optional<MessageId>, std::string> identify(const LogEvent& event);

}  // namespace lockstep::merge
