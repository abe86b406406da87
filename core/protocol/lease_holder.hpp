// The writer: the one client that gives commands to the machine; the others watch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/units.hpp"

namespace lockstep {

/// A person or a program on a host. Several clients may be one writer: the commands of one login.
struct LeaseHolder {
    std::uint64_t id = 0;  // 0: nobody
    std::string name;      // for a person, as the next; at most kMaxWriterBytes each, without control characters
    std::string host;
    bool operator==(const LeaseHolder&) const = default;
};

inline constexpr std::size_t kMaxWriterBytes = 63;

/// The machine has a writer.
struct HeldLease {
    LeaseHolder writer;
    Tick since;  // machine time
    bool operator==(const HeldLease&) const = default;
};

/// How often a client repeats its request for the lease while it keeps it, and after how long a silence it is lost.
inline constexpr std::int64_t kKeepLease_ms = 500;
inline constexpr std::int64_t kLeaseSilence_ms = 3000;

}  // namespace lockstep
