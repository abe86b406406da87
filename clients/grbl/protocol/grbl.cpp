#include "clients/grbl/protocol/grbl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

#include "clients/grbl/protocol/jog_line.hpp"
#include "clients/grbl/protocol/remedy_words.hpp"

namespace lockstep::grbl {
namespace {

// Real-time bytes.
constexpr unsigned char kSoftReset = 0x18;
constexpr unsigned char kDoor = 0x84;
constexpr unsigned char kCancelJog = 0x85;
constexpr unsigned char kFeedUsual = 0x90;
constexpr unsigned char kFeedMore = 0x91;
constexpr unsigned char kFeedLess = 0x92;
constexpr unsigned char kFeedLittleMore = 0x93;
constexpr unsigned char kFeedLittleLess = 0x94;
constexpr unsigned char kRapidUsual = 0x95;
constexpr unsigned char kRapidHalf = 0x96;
constexpr unsigned char kRapidQuarter = 0x97;

std::string capitals(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (std::isspace(static_cast<unsigned char>(c)) != 0) { continue; }
        result += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    return result;
}

}  // namespace

Grbl::Grbl(const MachineSetup& machine, std::string version)
    : shared_(machine), gcode_(shared_), system_(shared_, std::move(version)) {}

void Grbl::greet() {
    shared_.output.say("");
    shared_.output.say(kGreeting);
    begin();
}

void Grbl::begin() {
    report_.restart();
    if (shared_.state() == State::Alarm) { shared_.output.say("[MSG:'$H'|'$X' to unlock]"); }
}

void Grbl::receive(std::string_view bytes) {
    bool is_asked = false;
    for (const unsigned char byte : bytes_.take(bytes)) {
        if (byte == '?' && std::exchange(is_asked, true)) { continue; }  // several at once get one answer
        do_real_time(byte);
    }
    advance();
}

void Grbl::see(const MachineView& view) {
    const bool had_fault = shared_.view.is_received && shared_.view.phase == MachinePhase::Fault;
    const bool has_fault = view.is_received && view.phase == MachinePhase::Fault;
    const bool begins_pause = view.is_received && view.pause && view.pause != shared_.view.pause;
    shared_.view = view;
    if (begins_pause) { say_pause(); }
    if (const auto& awaited = shared_.requests.awaited(); awaited && awaited->runs_line) {
        shared_.view.lines = std::max<std::size_t>(shared_.view.lines, 1);
    }
    if (has_fault && !had_fault) {
        shared_.output.say(fmt::format("ALARM:{}", alarm_of(view.fault)));
        const FaultText* text = find_fault(view.fault);
        if (text != nullptr) {
            const std::string place = view.fault_place.empty() ? "" : view.fault_place + ": ";
            const FaultText fault = view.is_fault_of_board ? for_board(*text) : *text;
            shared_.output.say_message(
                fmt::format("{}{}: {}; {}", place, fault.name, fault.cause, remedy_text(fault, sender_words)));
        }
        shared_.modes.is_unlocked = false;
        shared_.lines.reset();
    }
    advance();
}

void Grbl::answer(std::uint64_t number, const Answer& answer) {
    auto awaited = shared_.requests.end(number);
    if (!awaited) { return; }
    if (answer.is_done && awaited->line) { shared_.lines.commit(*awaited->line); }
    if (answer.probe) { gcode_.take_touch(answer); }
    if (answer.is_done) {
        if (!awaited->before_ok.empty()) { shared_.output.say(awaited->before_ok); }
        shared_.output.ok();
    } else {
        shared_.has_jog = false;
        const Error of_fault = answer.why == FaultCode::OutsideTravel ? Error::TravelExceeded : Error::Locked;
        shared_.output.refuse(answer.error.value_or(of_fault), answer.text);
    }
    advance();
}

void Grbl::end_jog() {
    shared_.has_jog = false;
    advance();
}

void Grbl::do_real_time(unsigned char byte) {
    Overrides overrides = shared_.view.overrides;
    switch (byte) {
        case '?':
            return shared_.output.say(report_.text(shared_.view, shared_.state(),
                                                   shared_.lines.offset_mm(gcode_.values()), bytes_.room(),
                                                   shared_.options));
        case '!':
        case kDoor: return hold();
        case '~': return resume();
        case kSoftReset: return soft_reset();
        case kCancelJog:
            if (shared_.has_jog) { hold(); }
            return;
        case kFeedUsual: overrides.feed_percent = 100; break;
        case kFeedMore: overrides.feed_percent += 10; break;
        case kFeedLess: overrides.feed_percent -= 10; break;
        case kFeedLittleMore: overrides.feed_percent += 1; break;
        case kFeedLittleLess: overrides.feed_percent -= 1; break;
        case kRapidUsual: overrides.rapid_percent = 100; break;
        case kRapidHalf: overrides.rapid_percent = 50; break;
        case kRapidQuarter: overrides.rapid_percent = 25; break;
        default: return;  // for devices that the machine does not have, or meaningless
    }
    turn(overrides);
}

/// A sender cannot show and confirm the way back to the place of a pause.
void Grbl::resume() {
    if (shared_.state() != State::Hold) { return; }
    if (shared_.view.way_back.empty()) { return void(shared_.requests.add(Request::Kind::Resume)); }
    shared_.output.say_message(
        "axes were moved in the pause; way back: " + shared_.view.way_back +
        "; jog them back, or let the machine return and continue: lockstep resume --yes, or Resume on the page");
}

/// Tells a person why the machine waits. The person who gave a hold knows it.
void Grbl::say_pause() {
    if (shared_.view.pause->reason == PauseReason::Hold) { return; }
    std::string text = text_of(*shared_.view.pause);
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    shared_.output.say_message(text);
}

/// Stores the request in the view, so that a repeated step counts from it before the machine reports it.
void Grbl::turn(const Overrides& overrides) {
    shared_.view.overrides.feed_percent = std::clamp(overrides.feed_percent, Overrides::kLeast, Overrides::kMost);
    shared_.view.overrides.rapid_percent = std::clamp(overrides.rapid_percent, Overrides::kLeast, Overrides::kMost);
    shared_.requests.add(Request::Kind::Override).overrides = shared_.view.overrides;
}

/// A hold ends a jog, and drops the jog that waits.
void Grbl::hold() {
    if (shared_.has_jog) {
        (void)shared_.requests.add(Request::Kind::CancelJog);
        if (std::exchange(next_jog_, std::nullopt)) { shared_.output.ok(); }
    } else if (shared_.state() == State::Run) {
        (void)shared_.requests.add(Request::Kind::Hold);
    }
}

/// grbl stops the pulses at once and loses the position. Here the machine brakes on its path and keeps the position.
void Grbl::soft_reset() {
    const State before = shared_.state();
    if (shared_.has_jog) { (void)shared_.requests.add(Request::Kind::CancelJog); }
    const bool moves =
        before == State::Run || before == State::Hold || before == State::HoldEnding || before == State::Home;
    if (moves) { shared_.stop(); }
    shared_.modes = {.is_unlocked = shared_.modes.is_unlocked};
    forget_lines();
    greet();
}

void Grbl::leave() {
    bytes_.clear();
    forget_lines();
}

void Grbl::forget_lines() {
    gcode_.forget();
    shared_.requests.give_up();
    next_jog_.reset();
}

void Grbl::abort(const std::string& why) {
    (void)shared_.lines.switch_off();
    shared_.raise_alarm(kAbortAlarm, why);
    advance();
}

void Grbl::advance() {
    gcode_.switch_off();
    while (!shared_.requests.awaited()) {
        if ((next_jog_ && shared_.has_jog) || gcode_.must_wait()) { return; }
        if (next_jog_) {
            do_line(*std::exchange(next_jog_, std::nullopt));
        } else if (const auto next = gcode_.take_next()) {
            do_line(*next);
        } else if (bytes_.has_line()) {
            do_line(bytes_.next_line());
        } else {
            return;
        }
    }
}

void Grbl::do_line(const ReceivedLine& line) {
    if (line.is_too_long) { return shared_.output.refuse(Error::LineTooLong); }
    const std::string text = capitals(line.text);
    if (text.starts_with("$J=")) { return shared_.has_jog ? void(next_jog_ = line) : jog(text.substr(3)); }
    if (text.empty()) { return shared_.output.ok(); }
    if (text == "$C") { return toggle_check(); }
    text.front() == '$' ? system_.do_line(std::string_view(text).substr(1)) : gcode_.do_line(line);
}

void Grbl::jog(std::string_view text) {
    const bool is_in_pause = shared_.state() == State::Hold && shared_.view.pause;
    if (shared_.state() != State::Idle && !is_in_pause) { return shared_.output.refuse(Error::NotIdle); }
    const JogModes modes{shared_.lines.inches(), shared_.lines.relative(), shared_.lines.offset_mm(gcode_.values())};
    auto jogs = read_jog(text, shared_.machine, shared_.view.axes, modes);
    if (!jogs) { return shared_.output.refuse(jogs.error().error, jogs.error().text); }
    if (jogs->empty()) { return shared_.output.ok(); }
    shared_.has_jog = true;
    shared_.requests.await(Request::Kind::Jog).jogs = std::move(*jogs);
}

void Grbl::toggle_check() {
    if (shared_.modes.is_checking) {
        shared_.output.say("[MSG:Disabled]");
        shared_.output.ok();
        return soft_reset();
    }
    if (shared_.state() != State::Idle || shared_.has_jog) { return shared_.output.refuse(Error::NotIdle); }
    shared_.modes.is_checking = true;
    gcode_.begin_check();
    shared_.output.say("[MSG:Enabled]");
    shared_.output.ok();
}

}  // namespace lockstep::grbl
