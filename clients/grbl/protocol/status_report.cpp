#include "clients/grbl/protocol/status_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/grbl/protocol/number.hpp"
#include "clients/grbl/protocol/request.hpp"

namespace lockstep::grbl {
namespace {

// One in so many reports has WCO or Ov, as in grbl's config.h: REPORT_WCO_REFRESH_IDLE_COUNT and its siblings.
struct Cadence {
    int idle;
    int busy;
};
constexpr Cadence kOffsetsEvery{10, 30};
constexpr Cadence kOverridesEvery{10, 20};

const char* name_of(State state) {
    switch (state) {
        case State::Idle: return "Idle";
        case State::Run: return "Run";
        case State::Hold: return "Hold:0";
        case State::HoldEnding: return "Hold:1";
        case State::Jog: return "Jog";
        case State::Alarm: return "Alarm";
        case State::Check: return "Check";
        case State::Home: return "Home";
        case State::Sleep: break;
    }
    return "Sleep";
}

State state_of(MachinePhase phase) {
    switch (phase) {
        case MachinePhase::Idle: return State::Idle;
        case MachinePhase::Homing: return State::Home;
        case MachinePhase::Running: return State::Run;
        case MachinePhase::Stopping: return State::HoldEnding;
        case MachinePhase::Holding:
        case MachinePhase::Paused: return State::Hold;
        case MachinePhase::Jogging: return State::Jog;
        default: return State::Alarm;
    }
}

/// Whether a cycle is in progress, as grbl counts them: a hold is one, an alarm is none.
bool is_busy(State state) {
    switch (state) {
        case State::Run:
        case State::Hold:
        case State::HoldEnding:
        case State::Jog:
        case State::Home: return true;
        default: return false;
    }
}

bool is_in_program(State state) { return state == State::Run || state == State::Hold || state == State::HoldEnding; }

int reports_until(const Cadence& cadence, State state) { return (is_busy(state) ? cadence.busy : cadence.idle) - 1; }

}  // namespace

State state_of(const MachineView& view, const Modes& modes) {
    if (!view.is_received) { return State::Alarm; }
    const State state = state_of(view.phase);
    if (state == State::Run && view.is_held) { return State::HoldEnding; }
    if (state != State::Idle) { return state; }
    if (view.lines > 0) { return view.is_held ? State::Hold : State::Run; }
    if (!view.is_at_rest()) { return State::Run; }  // the axes' reports may be older than the machine's state
    if (modes.is_asleep) { return State::Sleep; }
    if (modes.is_aborted || (!view.is_homed() && !modes.is_unlocked)) { return State::Alarm; }
    return modes.is_checking ? State::Check : State::Idle;
}

std::string places_text(const std::vector<double>& mm, bool inches) {
    std::string text;
    for (const double place : mm) {
        text += (text.empty() ? "" : ",") + (inches ? number(place / kInch_mm, 4) : number(place, 3));
    }
    return text;
}

std::string StatusReport::text(const MachineView& view, State state, const std::vector<double>& offset_mm,
                               std::size_t room, const ReportOptions& options) {
    const bool has_machine_places = (options.mask & 1) != 0;
    std::vector<double> places;
    for (std::size_t i = 0; i < view.axes.size(); ++i) {
        places.push_back(view.axes[i].mm - (has_machine_places ? 0 : offset_mm[i]));
    }
    std::string text = std::string("<") + name_of(state) + (has_machine_places ? "|MPos:" : "|WPos:") +
                       places_text(places, options.inches);
    if ((options.mask & 2) != 0) {
        text += fmt::format("|Bf:{},{}", kPlannerLines - std::min(kPlannerLines, view.lines), room);
    }
    if (view.line && is_in_program(state)) { text += fmt::format("|Ln:{}", *view.line); }
    text += "|FS:" + number(options.inches ? view.feed_mm_min / kInch_mm : view.feed_mm_min, 0) + "," +
            number(view.devices.spindle_rpm, 0);
    const std::string closed = view.closed_switches + view.closed_inputs;
    if (!closed.empty()) { text += "|Pn:" + closed; }
    const std::string& accessories = view.accessories;
    if (offset_mm != offset_mm_) { offsets_due_ = 0; }
    if (view.overrides.feed_percent != overrides_.feed_percent ||
        view.overrides.rapid_percent != overrides_.rapid_percent || accessories != accessories_) {
        overrides_due_ = 0;
    }
    if (offsets_due_-- <= 0) {
        offsets_due_ = reports_until(kOffsetsEvery, state);
        overrides_due_ = std::max(overrides_due_, 1);  // a report has only one of the two, as in grbl
        offset_mm_ = offset_mm;
        text += "|WCO:" + places_text(offset_mm, options.inches);
    }
    if (overrides_due_-- <= 0) {
        overrides_due_ = reports_until(kOverridesEvery, state);
        overrides_ = view.overrides;
        accessories_ = accessories;
        text += fmt::format("|Ov:{},{},100", view.overrides.feed_percent, view.overrides.rapid_percent);
        if (!accessories.empty()) { text += "|A:" + accessories; }  // Ov without A means that all are off
    }
    return text + ">";
}

std::string probe_text(const ProbeResult& probe, bool inches) {
    const std::vector<double> places(probe.places_mm.begin(), probe.places_mm.end());
    return places_text(places, inches) + (probe.touched() ? ":1" : ":0");
}

}  // namespace lockstep::grbl
