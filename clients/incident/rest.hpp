// Finds which axes were moving and when they came to rest, from their notes.
#pragma once

#include <optional>

#include "clients/incident/incident.hpp"

namespace lockstep::incident {

struct Rest {
    std::optional<Tick> at;  // when the last axis came to rest; nullopt if none moved, or if no axis's rest is known
    MotorSet moving;         // those whose notes show motion
    MotorSet without_rest;   // those of them whose notes end, or have a gap, before they came to rest
};

/// The motion of all axes at `since`, and its end.
Rest rest_of(const Incident& incident, Tick since);

}  // namespace lockstep::incident
