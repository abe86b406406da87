// Writes an incident for a terminal: its cause, the first symptom, its end, and then the events in order.
#pragma once

#include <string>

#include "clients/incident/cause.hpp"
#include "clients/incident/sentences.hpp"

namespace lockstep::incident {

struct TextOptions {
    Weight least = Weight::Notable;  // of the listed events
    std::size_t width = 100;
};

std::string to_text(const Incident& incident, const Evaluation& evaluation, const TextOptions& options);

}  // namespace lockstep::incident
