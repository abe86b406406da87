// Collects the parts of a log that cannot be read or decoded, by reason, in bounded memory.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "services/wire/lcm/lcm_log.hpp"

namespace lockstep::analysis {

/// A part of the file, in bytes.
struct LogPlace {
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
};

/// Places in the file that cannot be read or decoded for one reason. Bytes count from the file's beginning.
struct Damage {
    std::uint64_t first_byte = 0;  // of the first place
    std::uint64_t last_byte = 0;   // of the last place
    std::uint64_t places = 0;
    std::uint64_t bytes = 0;  // of all places
    std::string what;
};

inline constexpr std::size_t kDamagesKept = 100;  // reasons; the last collects all further ones

void note_damage(std::vector<Damage>& all, LogPlace place, std::string what);

/// Reports all places that the reader has skipped so far, each with the reason.
void report_damages(const LogReader& reader, const std::function<void(LogPlace, std::string)>& on_damage);

/// "damaged at byte 17: ..., 3 bytes"
std::string damage_sentence(const Damage& damage);

}  // namespace lockstep::analysis
