#include "clients/grbl/protocol/grbl.hpp"

#include "clients/grbl/protocol/jog_line.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace lockstep::grbl {
namespace {

constexpr const char* kGreeting = "Grbl 1.1h ['$' for help]";
constexpr const char* kHelp = "[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]";

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

/// A message is one line, whatever is in it.
std::string message(const std::string& text) {
    std::string line = "[MSG:" + text + "]";
    std::ranges::replace_if(
        line, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return line;
}

}  // namespace

Grbl::Grbl(const MachineConfig& machine, std::string version)
    : machine_(machine), version_(std::move(version)), lines_(machine) {}

void Grbl::greet() {
    output_ += "\r\n";
    say(kGreeting);
    report_.restart();
    if (state() == State::Alarm) { say("[MSG:'$H'|'$X' to unlock]"); }
}

void Grbl::receive(std::string_view bytes) {
    bool is_asked = false;
    for (const unsigned char byte : bytes_.take(bytes)) {
        if (byte != '?') {
            do_real_time(byte);
        } else if (!std::exchange(is_asked, true)) {  // several at once are one question
            do_real_time(byte);
        }
    }
    advance();
}

void Grbl::see(const MachineView& view) {
    const bool had_fault = view_.is_received && view_.phase == MachinePhase::Fault;
    const bool has_fault = view.is_received && view.phase == MachinePhase::Fault;
    view_ = view;
    if (has_fault && !had_fault) {
        say("ALARM:" + std::to_string(alarm_of(view.fault)));
        const FaultText* text = find_fault(view.fault);
        if (text != nullptr) { say(message(std::string(text->name) + ": " + std::string(text->cause))); }
        modes_.is_unlocked = false;
    }
    advance();
}

void Grbl::answer(std::uint64_t number, const Answer& answer) {
    if (waits_for_ != number) { return; }
    waits_for_.reset();
    const std::string before = std::exchange(before_ok_, {});
    if (answer.is_done) {
        if (!before.empty()) { say(before); }
        ok();
    } else {
        has_jog_ = false;
        refuse(answer.why == FaultCode::OutsideTravel ? Error::TravelExceeded : Error::Locked, answer.text);
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
        case '?': return say(report_.text(view_, state(), lines_.offset_mm(view_.values), bytes_.room(), options_));
        case '!':
        case kDoor: return hold();
        case '~':
            if (state() == State::Hold) { (void)ask(Request::Kind::Resume); }
            return;
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
        default: return;  // of devices that the machine does not have, or without a meaning
    }
    turn(overrides);
}

/// Repeated before the machine has taken it, a step counts from what was asked for.
void Grbl::turn(const Overrides& overrides) {
    view_.overrides.feed_percent = std::clamp(overrides.feed_percent, Overrides::kLeast, Overrides::kMost);
    view_.overrides.rapid_percent = std::clamp(overrides.rapid_percent, Overrides::kLeast, Overrides::kMost);
    ask(Request::Kind::Override).overrides = view_.overrides;
}

/// A jog that is held is over, and so are those that wait.
void Grbl::hold() {
    if (has_jog_) {
        (void)ask(Request::Kind::CancelJog);
        if (std::exchange(next_jog_, std::nullopt)) { ok(); }
    } else if (state() == State::Run) {
        (void)ask(Request::Kind::Hold);
    }
}

/// grbl stops the pulses at once and forgets the place. Here the machine brakes on its path, and the place stays known.
void Grbl::soft_reset() {
    const State before = state();
    if (has_jog_) { (void)ask(Request::Kind::CancelJog); }
    const bool moves =
        before == State::Run || before == State::Hold || before == State::HoldEnding || before == State::Home;
    if (moves) { (void)ask(Request::Kind::Stop); }
    modes_ = {.is_unlocked = modes_.is_unlocked};
    lines_.reset();
    waits_for_.reset();
    before_ok_.clear();
    next_jog_.reset();
    greet();
}

void Grbl::advance() {
    while (!waits_for_) {
        if (next_jog_ && has_jog_) { return; }
        if (next_jog_) {
            do_line(*std::exchange(next_jog_, std::nullopt));
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
    text.front() == '$' ? do_system(std::string_view(text).substr(1)) : do_gcode(line.text);
}

void Grbl::do_system(std::string_view text) {
    if (text.empty()) {
        say(kHelp);
        return ok();
    }
    if (text == "$") { return print_settings(); }
    if (text == "#") { return print_parameters(); }
    if (text == "G") {
        say("[GC:" + lines_.modes_text() + "]");
        return ok();
    }
    if (text == "I") { return print_build(); }
    if (text.starts_with("N")) { return do_startup_block(text.substr(1)); }
    if (text == "X") { return unlock(); }
    if (text == "C") { return toggle_check(); }
    if (text.starts_with("J=")) { return do_jog(text.substr(2)); }
    if (text == "J") { return refuse(Error::BadJog, "write $J= and the axes"); }
    if (text.starts_with("RST=")) { return restore(text.substr(4)); }
    if (text.front() == 'H') { return do_home(text.substr(1)); }
    if (text == "SLP") {
        if (!is_quiet()) { return refuse(Error::NotIdle); }
        modes_.is_asleep = true;
        say("[MSG:Sleeping]");
        return ok();
    }
    write_setting(text);
}

/// A jog that has begun is one, before the machine's state shows it.
State Grbl::state() const {
    const State state = state_of(view_, modes_);
    return has_jog_ && state != State::Alarm ? State::Jog : state;
}

bool Grbl::is_quiet() const {
    const State now = state();
    return (now == State::Idle || now == State::Alarm) && !has_jog_;
}

void Grbl::do_gcode(const std::string& text) {
    const State now = state();
    if (now == State::Alarm || now == State::Sleep || has_jog_) {
        return refuse(Error::Locked, has_jog_ ? "a jog is in progress" : "");
    }
    const auto effect = lines_.take(text, view_);
    if (!effect) { return refuse(effect.error().error, effect.error().text); }
    if (effect->moves) {
        if (now == State::Check) { return ok(); }
        Request& request = ask(Request::Kind::RunLine);
        request.line = text;
        waits_for_ = request.number;
        return;
    }
    if (effect->ends_program) { say("[MSG:Pgm End]"); }
    if (!effect->values || now == State::Check) { return ok(); }
    Request& request = ask(Request::Kind::SetValues);
    request.values = *effect->values;
    waits_for_ = request.number;
}

void Grbl::do_jog(std::string_view text) {
    if (state() != State::Idle) { return refuse(Error::NotIdle); }
    const JogModes modes{lines_.inches(), lines_.relative(), lines_.offset_mm(view_.values)};
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

/// In Fault it is a reset. An axis that is not homed cannot be moved by programs all the same.
void Grbl::unlock() {
    if (state() != State::Alarm) { return ok(); }
    modes_.is_unlocked = true;
    if (view_.phase == MachinePhase::Fault) {
        waits_for_ = ask(Request::Kind::Reset).number;
        before_ok_ = "[MSG:Caution: Unlocked]";
        return;
    }
    say("[MSG:Caution: Unlocked]");
    ok();
}

void Grbl::toggle_check() {
    if (modes_.is_checking) {
        say("[MSG:Disabled]");
        ok();
        return soft_reset();
    }
    if (state() != State::Idle || has_jog_) { return refuse(Error::NotIdle); }
    modes_.is_checking = true;
    say("[MSG:Enabled]");
    ok();
}

void Grbl::restore(std::string_view what) {
    if (!is_quiet()) { return refuse(Error::NotIdle); }
    if (what != "$" && what != "#" && what != "*") { return refuse(Error::UnknownCommand); }
    if (what != "#") { options_ = {}; }
    if (what == "$") {
        say("[MSG:Restoring defaults]");
        return ok();
    }
    Request& request = ask(Request::Kind::SetValues);
    request.values = {.tools = view_.values.tools};
    waits_for_ = request.number;
    before_ok_ = "[MSG:Restoring defaults]";
}

void Grbl::do_startup_block(std::string_view text) {
    if (text.empty()) {
        say("$N0=");
        say("$N1=");
        return ok();
    }
    if (text == "0=" || text == "1=") { return ok(); }
    refuse(Error::UnknownCommand, "no blocks are run at the start");
}

void Grbl::write_setting(std::string_view text) {
    const std::size_t sign = text.find('=');
    int number = 0;
    const auto read = std::from_chars(text.data(), text.data() + std::min(sign, text.size()), number);
    const bool is_number = read.ec == std::errc{} && read.ptr == text.data() + sign;
    if (sign == std::string_view::npos || !is_number) { return refuse(Error::UnknownCommand); }
    const std::string_view word = text.substr(sign + 1);
    double value = 0;
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value, std::chars_format::fixed);
    if (parsed.ec != std::errc{} || parsed.ptr != word.data() + word.size() || !std::isfinite(value)) {
        return refuse(Error::BadNumber);
    }
    const auto written = grbl::write_setting(machine_, number, value, options_);
    written ? ok() : refuse(Error::UnknownCommand, written.error());
}

void Grbl::print_settings() {
    for (const Setting& setting : settings_of(machine_, options_)) {
        say("$" + std::to_string(setting.number) + "=" + setting.value);
    }
    ok();
}

void Grbl::print_parameters() {
    const auto places_of = [&](const gcode::Point& point) {
        std::vector<double> places;
        for (const AxisConfig& axis : machine_.axes) {
            const std::size_t letter =
                axis.name.size() == 1 ? gcode::kAxisLetters.find(axis.name[0]) : gcode::kAxisLetters.npos;
            places.push_back(letter == gcode::kAxisLetters.npos ? 0 : point[letter]);
        }
        return places_text(places, options_.inches);
    };
    std::vector<double> park;
    for (const AxisConfig& axis : machine_.axes) { park.push_back(axis.homing.park_mm); }
    const gcode::KeptValues& values = view_.values;
    for (int i = 0; i < 6; ++i) {
        say("[G" + std::to_string(54 + i) + ":" + places_of(values.systems[static_cast<std::size_t>(i)].origin) + "]");
    }
    const auto home_of = [&](const std::optional<gcode::Point>& place) {
        return place ? places_of(*place) : places_text(park, options_.inches);
    };
    say("[G28:" + home_of(values.home) + "]");
    say("[G30:" + home_of(values.second_home) + "]");
    say("[G92:" + places_of(values.g92_applies ? values.g92 : gcode::Point{}) + "]");
    say(std::string("[TLO:") + (options_.inches ? "0.0000]" : "0.000]"));
    say("[PRB:" + places_of({}) + ":0]");
    ok();
}

void Grbl::print_build() {
    say("[VER:1.1h.20190830:Lockstep " + version_ + "]");
    say("[OPT:NH,15," + std::to_string(kMaxWaiting) + "]");
    ok();
}

void Grbl::refuse(Error error, const std::string& text) {
    if (!text.empty()) { say(message(text)); }
    say("error:" + std::to_string(static_cast<int>(error)));
}

Request& Grbl::ask(Request::Kind kind) {
    requests_.push_back({.kind = kind, .number = ++number_});
    return requests_.back();
}

}  // namespace lockstep::grbl
