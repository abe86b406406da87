// Machine files with random values over all ranges of all keys.
#pragma once

#include <cstdint>
#include <string>

namespace lockstep {

/// The text of a machine file. The same seed gives the same text. Most values suit each other, because independent
/// values are nearly always refused; some are replaced by extremes or by any other value of their key's range.
std::string random_machine(std::uint64_t seed);

}  // namespace lockstep
