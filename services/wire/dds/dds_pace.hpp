// How often DDS in a machine's processes asks for presence, lost messages and acknowledgements. Each process asks all
// others, so the number of questions grows with the square of the number of processes. If many processes started at
// once with short periods, answers would flood their hosts, and the processes would regard each other as gone.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace lockstep {

/// Returns Cyclone DDS's settings for this number of processes, as XML: the content of its element Discovery, for
/// discovery by multicast.
std::string discovery_pace(std::size_t processes);
/// How long a process that ended without notice is regarded as present.
std::chrono::milliseconds discovery_lease(std::size_t processes);
/// Returns the content of its element Internal.
std::string repair_pace(std::size_t processes);

}  // namespace lockstep
