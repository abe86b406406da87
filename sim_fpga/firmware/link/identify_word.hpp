// How a host lets a board's light blink, so that a person finds the board among others.
#pragma once

#include <cstddef>

#include "sim_fpga/firmware/link/look_word.hpp"

namespace lockstep::firmware {

/// The host writes a new number there, of any motor. It stands at an address that the register map leaves free.
inline constexpr std::size_t kIdentifyWord = kLookWord + 0x28;

}  // namespace lockstep::firmware
