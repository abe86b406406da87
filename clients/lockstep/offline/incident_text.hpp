// An incident for a terminal: what began it, who noticed, how it ended; then what was noted, in order.
#pragma once

#include <string>

#include "clients/incident/cause.hpp"
#include "clients/incident/sentences.hpp"

namespace lockstep::incident {

struct TextOptions {
    Weight least = Weight::Notable;  // of what is listed
    std::size_t width = 100;
};

std::string to_text(const Incident& incident, const Verdict& verdict, const TextOptions& options);

}  // namespace lockstep::incident
