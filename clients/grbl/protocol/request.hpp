// What a sender's bytes ask of the machine.
#pragma once

#include <string>
#include <vector>

#include "core/faults.hpp"
#include "core/gcode/kept_values.hpp"
#include "core/overrides.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep::grbl {

struct Request {
    enum class Kind : std::uint8_t {
        Hold,
        Resume,
        Stop,
        Override,   // to `overrides`
        CancelJog,  // those above are real-time and not answered; those below are, by their number
        Reset,
        Home,       // `axes`; answered at its end
        Jog,        // `jogs`; answered when it has begun
        SetValues,  // to `values`
        RunLine     // of G-code that moves: `line`
    };
    Kind kind = Kind::Stop;
    std::uint64_t number = 0;
    AxisSet axes = 0;
    Overrides overrides;
    std::vector<JogAxis> jogs;
    gcode::KeptValues values;
    std::string line;
};

struct Answer {
    bool is_done = false;
    FaultCode why = FaultCode::None;  // of a refusal or a failure
    std::string text;                 // for a person
};

}  // namespace lockstep::grbl
