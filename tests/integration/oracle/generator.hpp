// Random programs over the whole language, by seed.
#pragma once

#include <cstdint>
#include <string>

namespace lockstep::oracle {

/// A program that is valid, as far as the generator knows; it ends with M2.
std::string valid_program(std::uint32_t seed);
/// The same without the tool table and without splines.
std::string plain_program(std::uint32_t seed);
/// A program in which a random word may make one line invalid.
std::string odd_program(std::uint32_t seed);

}  // namespace lockstep::oracle
