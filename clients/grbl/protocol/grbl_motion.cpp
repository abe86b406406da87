// Grbl: lines that move axes.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "clients/grbl/protocol/grbl.hpp"
#include "clients/grbl/protocol/jog_line.hpp"
#include "core/gcode/session/probe_touch.hpp"

namespace lockstep::grbl {
namespace {

Refused in_refused(const gcode::OWord& body) {
    return {
        Error::Unsupported,
        fmt::format("this line is within {}, which was refused, so it is not run either; send the end {}, or a reset",
                    gcode::shown_word(body), gcode::shown_word(body, gcode::end_of(body.keyword)))};
}

}  // namespace

/// The position where the next line begins.
std::vector<double> Grbl::place_mm() const {
    if (!planned_mm_.empty() && (view_.lines > 0 || modes_.is_checking)) { return planned_mm_; }
    std::vector<double> place;
    for (const AxisPlace& axis : view_.axes) { place.push_back(axis.mm); }
    return place;
}

/// The offsets and tools with which the next line begins. A check stores none in the machine.
const gcode::KeptValues& Grbl::values() const { return checked_values_ ? *checked_values_ : view_.values; }

/// Whether the position where the next line begins is known, from earlier lines or because the machine rests.
bool Grbl::is_settled() const {
    if (view_.is_stopping || view_.phase == MachinePhase::Stopping) { return false; }
    return view_.lines > 0 || view_.phase != MachinePhase::Idle || view_.is_at_rest();
}

void Grbl::do_gcode(const ReceivedLine& line) {
    const State now = state();
    if (now == State::Alarm || now == State::Sleep || has_jog_ || modes_.is_aborted) {
        return refuse(Error::Locked, has_jog_ ? "a jog is in progress" : "");
    }
    if (!is_settled()) {
        next_line_ = line;
        return;
    }
    if (const auto body = refused_body_.take(line.text)) { return refuse_gcode(in_refused(*body)); }
    auto effect = lines_.read(line.text, place_mm(), values());
    if (!effect) { return refuse_gcode(effect.error()); }
    const bool is_check = now == State::Check;
    if (!is_check && effect->rests_before && view_.lines > 0) {
        next_line_ = line;
        return;
    }
    const bool takes_machine = effect->line.changes_values || !effect->line.blocks.empty();
    if (!is_check && takes_machine && view_.lines == 0 && view_.phase != MachinePhase::Idle) {
        return refuse(Error::Locked, "another client's job is in progress");
    }
    do_effect(*std::move(effect), is_check);
}

/// A line that the machine must accept leaves its modes behind only when it has.
void Grbl::do_effect(LineEffect&& effect, bool is_check) {
    SessionLine& line = effect.line;
    for (const GcodeNote& note : line.notes) { say_message(note.text); }
    const std::string end = line.ends_program ? "[MSG:Pgm End]" : "";
    const std::int32_t number = effect.sender_line.value_or(++program_line_);
    if (line.ends_program) { program_line_ = 0; }
    planned_mm_ = line.place_mm;
    if (is_check) { checked_values_ = line.values; }
    if (is_check || (!line.changes_values && line.blocks.empty())) {
        lines_.commit(line);
        if (!end.empty()) { say(end); }
        return ok();
    }
    if (line.changes_values) {
        ask(Request::Kind::SetValues).values = line.values;
    } else {
        ask(Request::Kind::RunLine).line = {.blocks = std::move(line.blocks),
                                            .from_mm = line.head.start_mm,
                                            .seconds = effect.seconds,
                                            .sender_line = number,
                                            .is_answered_behind = effect.rests_behind || line.ends_program,
                                            .probes = line.awaits_touch};
        ++view_.lines;
        waits_for_line_ = true;
    }
    waits_for_ = number_;
    before_ok_ = end;
    asked_line_ = std::move(line);
}

/// The place of the next line is not known until the machine rests behind the touch: see is_settled().
void Grbl::take_touch(const Answer& answer) {
    const ProbeResult& probe = *answer.probe;
    std::vector<double> rest_mm;
    for (const AxisPlace& axis : view_.axes) { rest_mm.push_back(axis.mm); }
    const auto touch = touch_from(probe, std::move(rest_mm));
    if (!touch) { return raise_alarm(kNotTouchedAlarm, touch.error().text()); }
    lines_.touched(*touch);
    view_.probe = probe;
    view_.lines = 0;
    view_.is_stopping = true;
    if (answer.why == FaultCode::ProbeTouchedEarly) {
        return raise_alarm(kTouchedEarlyAlarm, "the probe touches before its move begins; move it away, then $X");
    }
    if (answer.why == FaultCode::ProbeNotTouched) {
        raise_alarm(kNotTouchedAlarm, "the probe did not touch within the move; check it and the place, then $X");
    }
    say("[PRB:" + probe_text(probe) + "]");
}

/// In machine coordinates, as grbl reports it.
std::string Grbl::probe_text(const ProbeResult& probe) const {
    const std::vector<double> places(probe.places_mm.begin(), probe.places_mm.end());
    return places_text(places, options_.inches) + (probe.touched ? ":1" : ":0");
}

/// A target outside the travel stops the machine and raises an alarm, as grbl's soft limits do, because the following
/// lines assume that it was reached.
void Grbl::refuse_gcode(const Refused& refused) {
    if (refused.error == Error::TravelExceeded && !modes_.is_checking) {
        if (view_.lines > 0) { stop(); }
        is_to_switch_off_ = lines_.switch_off() || is_to_switch_off_;
        raise_alarm(kTravelAlarm, refused.text);
        return refuse(refused.error);
    }
    refuse(refused.error, refused.text);
}

/// The coordinator switches spindle and coolant off when it stops a job. At rest there is no job, so this switches off
/// the devices that earlier lines left on, as grbl does at a reset.
void Grbl::switch_off() {
    const bool is_free = !waits_for_ && view_.lines == 0 && view_.phase == MachinePhase::Idle && is_settled();
    if (!is_to_switch_off_ || !view_.is_received || !is_free) { return; }
    is_to_switch_off_ = false;
    const ProgramDevices& devices = view_.devices;
    LineToRun line{.from_mm = place_mm()};
    if (devices.spindle != ProgramDevices::Spindle::Stopped) {
        line.blocks.push_back({.action = ProgramEvent{.kind = ProgramEvent::Kind::SpindleStop}});
    }
    if (devices.mist || devices.flood) {
        line.blocks.push_back({.action = ProgramEvent{.kind = ProgramEvent::Kind::CoolantOff}});
    }
    if (line.blocks.empty()) { return; }
    ask(Request::Kind::RunLine).line = std::move(line);
    ++view_.lines;
}

void Grbl::abort(const std::string& why) {
    (void)lines_.switch_off();
    raise_alarm(kAbortAlarm, why);
    advance();
}

void Grbl::raise_alarm(int number, const std::string& why) {
    say(fmt::format("ALARM:{}", number));
    say_message(why);
    modes_.is_aborted = true;
}

void Grbl::do_jog(std::string_view text) {
    const bool is_in_pause = state() == State::Hold && view_.pause;
    if (state() != State::Idle && !is_in_pause) { return refuse(Error::NotIdle); }
    const JogModes modes{lines_.inches(), lines_.relative(), lines_.offset_mm(values())};
    auto jogs = read_jog(text, machine_, view_.axes, modes);
    if (!jogs) { return refuse(jogs.error().error, jogs.error().text); }
    if (jogs->empty()) { return ok(); }
    has_jog_ = true;
    Request& request = ask(Request::Kind::Jog);
    request.jogs = std::move(*jogs);
    waits_for_ = request.number;
}

void Grbl::do_home(std::string_view axis) {
    if (!is_quiet()) { return refuse(Error::NotIdle); }
    modes_.is_aborted = false;
    AxisSet axes = 0;
    if (!axis.empty()) {
        const auto found = std::ranges::find(machine_.axes, axis, &AxisConfig::name);
        if (found == machine_.axes.end()) { return refuse(Error::UnknownCommand, "the machine has no such axis"); }
        axes = axis_bit(static_cast<std::size_t>(found - machine_.axes.begin()));
    }
    Request& request = ask(Request::Kind::Home);
    request.axes = axes;
    waits_for_ = request.number;
}

}  // namespace lockstep::grbl
