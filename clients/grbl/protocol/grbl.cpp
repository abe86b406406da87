#include "clients/grbl/protocol/grbl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>

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

Grbl::Grbl(const MachineConfig& machine, std::string version)
    : machine_(machine), next_machine_(machine), version_(std::move(version)), lines_(machine) {}

void Grbl::greet() {
    output_ += "\r\n";
    say(kGreeting);
    begin();
}

void Grbl::begin() {
    report_.restart();
    if (state() == State::Alarm) { say("[MSG:'$H'|'$X' to unlock]"); }
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
    const bool had_fault = view_.is_received && view_.phase == MachinePhase::Fault;
    const bool has_fault = view.is_received && view.phase == MachinePhase::Fault;
    const bool begins_pause = view.is_received && view.pause && view.pause != view_.pause;
    view_ = view;
    if (begins_pause) { say_pause(); }
    if (waits_for_ && waits_for_line_) { view_.lines = std::max<std::size_t>(view_.lines, 1); }
    if (has_fault && !had_fault) {
        say(fmt::format("ALARM:{}", alarm_of(view.fault)));
        const FaultText* text = find_fault(view.fault);
        if (text != nullptr) {
            const std::string place = view.fault_place.empty() ? "" : view.fault_place + ": ";
            const FaultText fault = view.is_fault_of_board ? for_board(*text) : *text;
            say_message(fmt::format("{}{}: {}; {}", place, fault.name, fault.cause, remedy_text(fault, sender_words)));
        }
        modes_.is_unlocked = false;
        lines_.reset();
    }
    advance();
}

void Grbl::answer(std::uint64_t number, const Answer& answer) {
    if (waits_for_ != number) { return; }
    waits_for_.reset();
    waits_for_line_ = false;
    const std::string before = std::exchange(before_ok_, {});
    auto line = std::exchange(asked_line_, std::nullopt);
    if (answer.is_done && line) { lines_.commit(*line); }
    if (answer.probe) { take_touch(answer); }
    if (answer.is_done) {
        if (!before.empty()) { say(before); }
        ok();
    } else {
        has_jog_ = false;
        const Error of_fault = answer.why == FaultCode::OutsideTravel ? Error::TravelExceeded : Error::Locked;
        refuse(answer.error.value_or(of_fault), answer.text);
    }
    advance();
}

void Grbl::end_jog() {
    has_jog_ = false;
    advance();
}

void Grbl::do_real_time(unsigned char byte) {
    Overrides overrides = view_.overrides;
    switch (byte) {
        case '?': return say(report_.text(view_, state(), lines_.offset_mm(values()), bytes_.room(), options_));
        case '!':
        case kDoor: return hold();
        case '~': return resume();
        case kSoftReset: return soft_reset();
        case kCancelJog:
            if (has_jog_) { hold(); }
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
    if (state() != State::Hold) { return; }
    if (view_.way_back.empty()) { return void(ask(Request::Kind::Resume)); }
    say_message(
        "axes were moved in the pause; way back: " + view_.way_back +
        "; jog them back, or let the machine return and continue: lockstep resume --yes, or Resume on the page");
}

/// Tells a person why the machine waits. The person who gave a hold knows it.
void Grbl::say_pause() {
    if (view_.pause->reason == PauseReason::Hold) { return; }
    std::string text = text_of(*view_.pause);
    text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    say_message(text);
}

/// Stores the request in the view, so that a repeated step counts from it before the machine reports it.
void Grbl::turn(const Overrides& overrides) {
    view_.overrides.feed_percent = std::clamp(overrides.feed_percent, Overrides::kLeast, Overrides::kMost);
    view_.overrides.rapid_percent = std::clamp(overrides.rapid_percent, Overrides::kLeast, Overrides::kMost);
    ask(Request::Kind::Override).overrides = view_.overrides;
}

/// A hold ends a jog, and drops the jog that waits.
void Grbl::hold() {
    if (has_jog_) {
        (void)ask(Request::Kind::CancelJog);
        if (std::exchange(next_jog_, std::nullopt)) { ok(); }
    } else if (state() == State::Run) {
        (void)ask(Request::Kind::Hold);
    }
}

/// grbl stops the pulses at once and loses the position. Here the machine brakes on its path and keeps the position.
void Grbl::soft_reset() {
    const State before = state();
    if (has_jog_) { (void)ask(Request::Kind::CancelJog); }
    const bool moves =
        before == State::Run || before == State::Hold || before == State::HoldEnding || before == State::Home;
    if (moves) { stop(); }
    modes_ = {.is_unlocked = modes_.is_unlocked};
    forget_lines();
    greet();
}

void Grbl::leave() {
    bytes_.clear();
    forget_lines();
}

void Grbl::forget_lines() {
    is_to_switch_off_ = lines_.switch_off() || is_to_switch_off_;
    lines_.reset();
    waits_for_.reset();
    waits_for_line_ = false;
    asked_line_.reset();
    before_ok_.clear();
    next_jog_.reset();
    next_line_.reset();
    refused_body_.clear();
    program_line_ = 0;
    planned_mm_.clear();
    checked_values_.reset();
}

/// Until the machine rests, its position is not known.
void Grbl::stop() {
    (void)ask(Request::Kind::Stop);
    view_.is_stopping = true;
    view_.lines = 0;
}

void Grbl::advance() {
    switch_off();
    while (!waits_for_) {
        if (next_jog_ && has_jog_) { return; }
        if (next_line_ && (view_.lines > 0 || !is_settled())) { return; }
        if (next_jog_) {
            do_line(*std::exchange(next_jog_, std::nullopt));
        } else if (next_line_) {
            do_line(*std::exchange(next_line_, std::nullopt));
        } else if (bytes_.has_line()) {
            do_line(bytes_.next_line());
        } else {
            return;
        }
    }
}

void Grbl::do_line(const ReceivedLine& line) {
    if (line.is_too_long) { return refuse(Error::LineTooLong); }
    const std::string text = capitals(line.text);
    if (text.starts_with("$J=") && has_jog_) {
        next_jog_ = line;
        return;
    }
    if (text.empty()) { return ok(); }
    text.front() == '$' ? do_system(std::string_view(text).substr(1)) : do_gcode(line);
}

/// A requested jog counts as Jog before the machine's state shows it.
State Grbl::state() const {
    const State state = state_of(view_, modes_);
    return has_jog_ && state != State::Alarm ? State::Jog : state;
}

bool Grbl::is_quiet() const {
    const State now = state();
    return (now == State::Idle || now == State::Alarm) && !has_jog_;
}

/// Replaces line ends, because a message is one line.
void Grbl::say_message(const std::string& text) {
    std::string line = "[MSG:" + text + "]";
    std::ranges::replace_if(
        line, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    say(line);
}

void Grbl::refuse(Error error, const std::string& text) {
    if (!text.empty()) { say_message(text); }
    say(fmt::format("error:{}", static_cast<int>(error)));
}

Request& Grbl::ask(Request::Kind kind) {
    requests_.push_back({.kind = kind, .number = ++number_});
    return requests_.back();
}

}  // namespace lockstep::grbl
