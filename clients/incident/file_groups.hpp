// Groups incident files whose notes have one time line.
#pragma once

#include <vector>

#include "clients/incident/flight_file.hpp"

namespace lockstep::incident {

/// In the order of the incidents' machine times. Never empty. The files must outlive it.
using FileGroup = std::vector<const FlightFile*>;

/// The oldest group first, by wall time. Files belong together if their notes overlap, or if their incidents are at
/// most 10 s of machine time apart; but not if more than a day of wall time lies between them, because then machine
/// time began again in between.
std::vector<FileGroup> grouped(const std::vector<FlightFile>& files);

}  // namespace lockstep::incident
