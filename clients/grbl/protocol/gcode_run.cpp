#include "clients/grbl/protocol/gcode_run.hpp"

#include <fmt/format.h>

#include <utility>

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
std::vector<double> GcodeRun::place_mm() const {
    if (!planned_mm_.empty() && (shared_.view.lines > 0 || shared_.modes.is_checking)) { return planned_mm_; }
    std::vector<double> place;
    for (const AxisPlace& axis : shared_.view.axes) { place.push_back(axis.mm); }
    return place;
}

void GcodeRun::do_line(const ReceivedLine& line) {
    const State now = shared_.state();
    if (now == State::Alarm || now == State::Sleep || shared_.has_jog || shared_.modes.is_aborted) {
        return shared_.output.refuse(Error::Locked, shared_.has_jog ? "a jog is in progress" : "");
    }
    if (!shared_.is_settled()) {
        next_ = line;
        return;
    }
    if (const auto body = refused_body_.take(line.text)) { return refuse(in_refused(*body)); }
    auto effect = shared_.lines.read(line.text, place_mm(), values());
    if (!effect) { return refuse(effect.error()); }
    const bool is_check = now == State::Check;
    if (!is_check && effect->rests_before && shared_.view.lines > 0) {
        next_ = line;
        return;
    }
    const bool takes_machine = effect->line.changes_values || !effect->line.blocks.empty();
    if (!is_check && takes_machine && shared_.view.lines == 0 && shared_.view.phase != MachinePhase::Idle) {
        return shared_.output.refuse(Error::Locked, "another client's job is in progress");
    }
    do_effect(*std::move(effect), is_check);
}

void GcodeRun::do_effect(LineEffect&& effect, bool is_check) {
    SessionLine& line = effect.line;
    for (const GcodeNote& note : line.notes) { shared_.output.say_message(note.text); }
    const std::string end = line.ends_program ? "[MSG:Pgm End]" : "";
    const std::int32_t number = effect.sender_line.value_or(++line_);
    if (line.ends_program) { line_ = 0; }
    planned_mm_ = line.place_mm;
    if (is_check) { checked_values_ = line.values; }
    if (is_check || (!line.changes_values && line.blocks.empty())) {
        shared_.lines.commit(line);
        if (!end.empty()) { shared_.output.say(end); }
        return shared_.output.ok();
    }
    pass_to_machine(std::move(effect), number, end);
}

/// A line that the machine must accept leaves its modes behind only when it has.
void GcodeRun::pass_to_machine(LineEffect&& effect, std::int32_t number, const std::string& before_ok) {
    SessionLine& line = effect.line;
    if (line.changes_values) {
        Request& request = shared_.requests.await(Request::Kind::SetValues, before_ok, line);
        request.values = std::move(line.values);
        return;
    }
    LineToRun run{.blocks = std::exchange(line.blocks, {}),
                  .from_mm = line.head.start_mm,
                  .seconds = effect.seconds,
                  .sender_line = number,
                  .is_answered_behind = effect.rests_behind || line.ends_program,
                  .probes = line.awaits_touch};
    shared_.requests.await(Request::Kind::RunLine, before_ok, std::move(line)).line = std::move(run);
    ++shared_.view.lines;
}

/// The place of the next line is not known until the machine rests behind the touch: see Connection::is_settled().
void GcodeRun::take_touch(const Answer& answer) {
    const ProbeResult& probe = *answer.probe;
    std::vector<double> rest_mm;
    for (const AxisPlace& axis : shared_.view.axes) { rest_mm.push_back(axis.mm); }
    const auto touch = touch_from(probe, std::move(rest_mm));
    if (!touch) { return shared_.raise_alarm(kNotTouchedAlarm, touch.error().text()); }
    shared_.lines.touched(*touch);
    shared_.view.probe = probe;
    shared_.view.lines = 0;
    shared_.view.is_stopping = true;
    if (answer.why == FaultCode::ProbeTouchedEarly) {
        return shared_.raise_alarm(kTouchedEarlyAlarm,
                                   "the probe touches before its move begins; move it away, then $X");
    }
    if (answer.why == FaultCode::ProbeNotTouched) {
        shared_.raise_alarm(kNotTouchedAlarm,
                            "the probe did not touch within the move; check it and the place, then $X");
    }
    shared_.output.say("[PRB:" + probe_text(probe, shared_.options.inches) + "]");
}

/// A target outside the travel stops the machine and raises an alarm, as grbl's soft limits do, because the following
/// lines assume that it was reached.
void GcodeRun::refuse(const Refused& refused) {
    if (refused.error == Error::TravelExceeded && !shared_.modes.is_checking) {
        if (shared_.view.lines > 0) { shared_.stop(); }
        is_to_switch_off_ = shared_.lines.switch_off() || is_to_switch_off_;
        shared_.raise_alarm(kTravelAlarm, refused.text);
        return shared_.output.refuse(refused.error);
    }
    shared_.output.refuse(refused.error, refused.text);
}

void GcodeRun::forget() {
    is_to_switch_off_ = shared_.lines.switch_off() || is_to_switch_off_;
    shared_.lines.reset();
    next_.reset();
    refused_body_.clear();
    line_ = 0;
    planned_mm_.clear();
    checked_values_.reset();
}

/// The coordinator switches spindle and coolant off when it stops a job. At rest there is no job, so this switches off
/// the devices that earlier lines left on, as grbl does at a reset.
void GcodeRun::switch_off() {
    const bool is_free = !shared_.requests.awaited() && shared_.view.lines == 0 &&
                         shared_.view.phase == MachinePhase::Idle && shared_.is_settled();
    if (!is_to_switch_off_ || !shared_.view.is_received || !is_free) { return; }
    is_to_switch_off_ = false;
    LineToRun line{.from_mm = place_mm()};
    for (const ProgramEvent& word : shared_.view.devices.words_off()) { line.blocks.push_back({.action = word}); }
    if (line.blocks.empty()) { return; }
    shared_.requests.add(Request::Kind::RunLine).line = std::move(line);
    ++shared_.view.lines;
}

}  // namespace lockstep::grbl
