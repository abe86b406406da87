// The writer is the one client that may give commands to the machine. All others only watch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/units.hpp"

namespace lockstep {

/// A person or a program on a host. Several clients may act as one writer, for example the commands of one login.
struct LeaseHolder {
    std::uint64_t id = 0;  // 0: nobody
    std::string name;      // name and host are for people; at most kMaxWriterBytes each, without control characters
    std::string host;
    bool operator==(const LeaseHolder&) const = default;
};

inline constexpr std::size_t kMaxWriterBytes = 63;

/// The lease while the machine has a writer.
struct HeldLease {
    LeaseHolder writer;
    Tick since;  // machine time
    bool operator==(const HeldLease&) const = default;
};

/// A client that keeps the lease repeats its request every kKeepLease_ms. It loses the lease after kLeaseSilence_ms of
/// silence.
inline constexpr std::int64_t kKeepLease_ms = 500;
inline constexpr std::int64_t kLeaseSilence_ms = 3000;

}  // namespace lockstep
