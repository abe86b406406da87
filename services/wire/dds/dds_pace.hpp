// How often the processes of a machine ask and answer each other below what they say: whether they are there, what was
// lost, what has arrived. Each asks all others, so N processes ask N^2 times as often as one; where they are many,
// hosts that start them all at once would be flooded by answers, and take each other for gone.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace lockstep {

/// Cyclone DDS's settings for so many processes, as XML: of its element Discovery, where multicast finds them.
std::string discovery_pace(std::size_t processes);
/// How long a process that has ended without a word is then taken for present.
std::chrono::milliseconds discovery_lease(std::size_t processes);
/// Of its element Internal.
std::string repair_pace(std::size_t processes);

}  // namespace lockstep
