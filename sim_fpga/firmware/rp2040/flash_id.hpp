// The number that the maker of the flash gave to it.
#pragma once

#include <cstdint>

namespace lockstep::firmware {

/// Call it before interrupts begin. The flash cannot be read as memory afterwards. Returns 0 if there is no such
/// number.
std::uint64_t read_flash_id();

}  // namespace lockstep::firmware
