#include "clients/grbl/protocol/system_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "clients/grbl/protocol/received_bytes.hpp"
#include "clients/grbl/protocol/settings.hpp"
#include "core/parse_number.hpp"

namespace lockstep::grbl {
namespace {

constexpr const char* kHelp = "[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]";
constexpr const char* kInForce = "applies after: lockstep down; lockstep up";

}  // namespace

void SystemLines::do_line(std::string_view text) {
    if (text.empty()) {
        shared_.output.say(kHelp);
        return shared_.output.ok();
    }
    if (text == "$") { return print_settings(); }
    if (text == "#") { return print_parameters(); }
    if (text == "G") {
        shared_.output.say("[GC:" + shared_.lines.modes_text() + "]");
        return shared_.output.ok();
    }
    if (text == "I") { return print_build(); }
    if (text.starts_with("N")) { return do_startup_block(text.substr(1)); }
    if (text == "X") { return unlock(); }
    if (text == "J") { return shared_.output.refuse(Error::BadJog, "a jog needs its axes; write them after $J="); }
    if (text.starts_with("RST=")) { return restore(text.substr(4)); }
    if (text.front() == 'H') { return home(text.substr(1)); }
    if (text == "SLP") { return sleep(); }
    write_setting(text);
}

void SystemLines::sleep() {
    if (!shared_.is_quiet()) { return shared_.output.refuse(Error::NotIdle); }
    shared_.modes.is_asleep = true;
    shared_.output.say("[MSG:Sleeping]");
    shared_.output.ok();
}

void SystemLines::home(std::string_view axis) {
    if (!shared_.is_quiet()) { return shared_.output.refuse(Error::NotIdle); }
    shared_.modes.is_aborted = false;
    AxisSet axes;
    if (!axis.empty()) {
        const auto found = shared_.machine.axis_named(axis);
        if (!found) { return shared_.output.refuse(Error::UnknownCommand, "the machine has no such axis"); }
        axes.insert(*found);
    }
    shared_.requests.await(Request::Kind::Home).axes = axes;
}

/// In Fault this resets the machine. Programs still cannot move an axis that is not homed.
void SystemLines::unlock() {
    if (shared_.state() != State::Alarm && !shared_.modes.is_aborted) { return shared_.output.ok(); }
    shared_.modes.is_unlocked = true;
    shared_.modes.is_aborted = false;
    if (shared_.view.phase == MachinePhase::Fault) {
        return void(shared_.requests.await(Request::Kind::Reset, "[MSG:Caution: Unlocked]"));
    }
    shared_.output.say("[MSG:Caution: Unlocked]");
    shared_.output.ok();
}

void SystemLines::restore(std::string_view what) {
    if (!shared_.is_quiet()) { return shared_.output.refuse(Error::NotIdle); }
    if (what != "$" && what != "#" && what != "*") { return shared_.output.refuse(Error::UnknownCommand); }
    if (what != "#") { shared_.options = {}; }
    const auto kind = what == "$" ? Request::Kind::DropSettings : Request::Kind::SetValues;
    Request& request = shared_.requests.await(kind, "[MSG:Restoring defaults]");
    request.values = {.tools = shared_.view.values.tools};
    request.drops_settings = what == "*";
}

void SystemLines::do_startup_block(std::string_view text) {
    if (text.empty()) {
        shared_.output.say("$N0=");
        shared_.output.say("$N1=");
        return shared_.output.ok();
    }
    if (text == "0=" || text == "1=") { return shared_.output.ok(); }
    shared_.output.refuse(Error::UnknownCommand, "this machine runs no blocks at its start");
}

void SystemLines::write_setting(std::string_view text) {
    const std::size_t sign = text.find('=');
    if (sign == std::string_view::npos) { return shared_.output.refuse(Error::UnknownCommand); }
    const auto number = parse_number<int>(text.substr(0, sign));
    if (!number) { return shared_.output.refuse(Error::UnknownCommand); }
    const std::string_view word = text.substr(sign + 1);
    double value = 0;
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value, std::chars_format::fixed);
    if (parsed.ec != std::errc{} || parsed.ptr != word.data() + word.size() || !std::isfinite(value)) {
        return shared_.output.refuse(Error::BadNumber);
    }
    keep_setting(*number, value);
}

void SystemLines::keep_setting(int number, double value) {
    const auto written = grbl::write_setting(next_machine_, number, value, shared_.options);
    if (!written) { return shared_.output.refuse(written.error().error, written.error().text); }
    if (written->empty()) { return shared_.output.ok(); }
    if (!shared_.is_quiet()) { return shared_.output.refuse(Error::NotIdle); }
    const std::string stored = fmt::format("[MSG:${} is stored and {}]", number, kInForce);
    shared_.requests.await(Request::Kind::KeepSettings, stored).settings = *written;
}

/// Prints the settings as written, and names those that are not in force yet.
void SystemLines::print_settings() {
    const auto in_force = settings_of(shared_.machine, shared_.options);
    std::string later;
    for (const Setting& setting : settings_of(next_machine_, shared_.options)) {
        const std::string name = fmt::format("${}", setting.number);
        shared_.output.say(name + "=" + setting.value);
        const auto now = std::ranges::find(in_force, setting.number, &Setting::number);
        if (now->value != setting.value) { later += name + " "; }
    }
    if (!later.empty()) { shared_.output.say_message(later + kInForce); }
    shared_.output.ok();
}

void SystemLines::print_parameters() {
    const auto places_of = [&](const gcode::Point& point) {
        std::vector<double> places;
        for (const AxisConfig& axis : shared_.machine.axes) {
            const auto letter = gcode::axis_place(axis.name);
            places.push_back(letter ? point[*letter] : 0);
        }
        return places_text(places, shared_.options.inches);
    };
    std::vector<double> park;
    for (const AxisConfig& axis : shared_.machine.axes) { park.push_back(axis.homing.park_mm); }
    const gcode::KeptValues& values = shared_.view.values;
    for (int i = 0; i < 6; ++i) {
        shared_.output.say(
            fmt::format("[G{}:{}]", 54 + i, places_of(values.systems[static_cast<std::size_t>(i)].origin)));
    }
    const auto home_of = [&](const std::optional<gcode::Point>& place) {
        return place ? places_of(*place) : places_text(park, shared_.options.inches);
    };
    shared_.output.say("[G28:" + home_of(values.home) + "]");
    shared_.output.say("[G30:" + home_of(values.second_home) + "]");
    shared_.output.say("[G92:" + places_of(values.g92_applies ? values.g92 : gcode::Point{}) + "]");
    shared_.output.say("[TLO:" + places_text({shared_.lines.tool_length_mm()}, shared_.options.inches) + "]");
    shared_.output.say(
        "[PRB:" +
        (shared_.view.probe ? probe_text(*shared_.view.probe, shared_.options.inches) : places_of({}) + ":0") + "]");
    shared_.output.ok();
}

void SystemLines::print_build() {
    shared_.output.say("[VER:1.1h.20190830:Lockstep " + version_ + "]");
    shared_.output.say(fmt::format("[OPT:NH,{},{}]", kPlannerLines, kMaxWaiting));
    shared_.output.ok();
}

}  // namespace lockstep::grbl
