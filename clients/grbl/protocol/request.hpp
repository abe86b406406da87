// The requests of a sender to the machine.
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

/// At least this many lines are accepted before they are run, of any length, for the machine's look-ahead. Senders read
/// it as the size of grbl's planner.
inline constexpr std::size_t kPlannerLines = 128;

/// A line of G-code that takes time.
struct LineToRun {
    std::vector<Block> blocks;
    std::vector<double> from_mm;              // of each axis, where the line begins
    double seconds = 0;                       // approximate duration
    std::optional<std::int32_t> sender_line;  // for reports
    bool is_answered_behind = false;          // answered after it was run, else when it is accepted
    bool probes = false;  // its last block is a probing move, and the next line depends on the touch
};

struct Request {
    enum class Kind : std::uint8_t {
        Hold,
        Resume,
        Stop,
        Override,   // to `overrides`
        CancelJog,  // up to here real-time and not answered; the following are answered by number
        Reset,
        Home,          // `axes`; answered at its end
        Jog,           // `jogs`; answered when it has begun
        SetValues,     // to `values`; also drops the settings if `drops_settings`
        KeepSettings,  // `settings`
        DropSettings,  // all kept settings
        RunLine        // `line`; answered when accepted, or after it was run if is_answered_behind
    };
    Kind kind = Kind::Stop;
    std::uint64_t number = 0;
    AxisSet axes;
    Overrides overrides;
    std::vector<JogAxis> jogs;
    gcode::KeptValues values;
    bool drops_settings = false;
    KeptSettings settings;
    LineToRun line;
};

struct Answer {
    bool is_done = false;
    FaultCode why = FaultCode::None;   // reason of a refusal or a failure
    std::string text;                  // for a person
    std::optional<Error> error;        // if it is not the error for the fault `why`
    std::optional<ProbeResult> probe;  // of a line that probes, which was run
};

}  // namespace lockstep::grbl
