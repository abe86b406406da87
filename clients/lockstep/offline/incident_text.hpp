// Writes an incident for a terminal: its cause, the first symptom, its end, and then the events in order; and the list
// of all incidents in the files.
#pragma once

#include <string>

#include "clients/incident/cause.hpp"
#include "clients/incident/sentences.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep::incident {

struct TextOptions {
    Weight least = Weight::Notable;  // of the listed events
    std::size_t width = 100;
};

std::string to_text(const Incident& incident, const Evaluation& evaluation, const TextOptions& options);

/// A line for each incident of the report, at most ten; the one that the report is about is among them. Empty if there
/// is no other.
std::string list_text(const proto::IncidentReport& report, std::size_t width = TextOptions{}.width);

}  // namespace lockstep::incident
