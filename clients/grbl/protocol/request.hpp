// What a sender's bytes ask of the machine.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "clients/grbl/protocol/errors.hpp"
#include "core/faults.hpp"
#include "core/gcode/kept_values.hpp"
#include "core/overrides.hpp"
#include "core/program.hpp"
#include "core/protocol/messages.hpp"
#include "services/documents/edit/kept_settings.hpp"

namespace lockstep::grbl {

/// So many lines at least are accepted before they are run: the machine's look-ahead takes that many, however long they
/// are. Senders read it as the size of grbl's planner.
inline constexpr std::size_t kPlannerLines = 128;

/// A line of G-code that takes time.
struct LineToRun {
    std::vector<Block> blocks;
    std::vector<double> from_mm;      // of each axis, where it begins
    double seconds = 0;               // that it takes, about
    std::int32_t sender_line = 0;     // its N word; 0: none
    bool is_answered_behind = false;  // when it was run; else when it is accepted
};

struct Request {
    enum class Kind : std::uint8_t {
        Hold,
        Resume,
        Stop,
        Override,   // to `overrides`
        CancelJog,  // those above are real-time and not answered; those below are, by their number
        Reset,
        Home,          // `axes`; answered at its end
        Jog,           // `jogs`; answered when it has begun
        SetValues,     // to `values`; and where `drops_settings`, that too
        KeepSettings,  // `settings`
        DropSettings,  // all that were kept
        RunLine        // `line`; answered when it is accepted, or was run where it says so
    };
    Kind kind = Kind::Stop;
    std::uint64_t number = 0;
    AxisSet axes = 0;
    Overrides overrides;
    std::vector<JogAxis> jogs;
    gcode::KeptValues values;
    bool drops_settings = false;
    KeptSettings settings;
    LineToRun line;
};

struct Answer {
    bool is_done = false;
    FaultCode why = FaultCode::None;  // of a refusal or a failure
    std::string text;                 // for a person
    std::optional<Error> error = {};  // where it is not that of the fault
};

}  // namespace lockstep::grbl
