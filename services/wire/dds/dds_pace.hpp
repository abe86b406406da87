// How often DDS in the processes of a machine asks and answers: for presence, for lost messages, for acknowledgements.
// Each process asks all others, so N processes ask N^2 times as often as one. With many processes, hosts that start
// them all at once would be flooded by answers, and regard each other as gone.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace lockstep {

/// Cyclone DDS's settings for so many processes, as XML: of its element Discovery, if multicast is used for discovery.
std::string discovery_pace(std::size_t processes);
/// How long a process that ended without notice is regarded as present.
std::chrono::milliseconds discovery_lease(std::size_t processes);
/// The settings of its element Internal.
std::string repair_pace(std::size_t processes);

}  // namespace lockstep
