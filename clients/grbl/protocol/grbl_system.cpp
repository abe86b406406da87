// Grbl: lines that begin with $.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "clients/grbl/protocol/grbl.hpp"
#include "core/parse_number.hpp"

namespace lockstep::grbl {
namespace {

constexpr const char* kHelp = "[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]";
constexpr const char* kInForce = "applies after: lockstep down; lockstep up";

}  // namespace

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
    if (text == "J") { return refuse(Error::BadJog, "a jog needs its axes; write them after $J="); }
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

/// In Fault this resets the machine. Programs still cannot move an axis that is not homed.
void Grbl::unlock() {
    if (state() != State::Alarm && !modes_.is_aborted) { return ok(); }
    modes_.is_unlocked = true;
    modes_.is_aborted = false;
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
    planned_mm_.clear();
    say("[MSG:Enabled]");
    ok();
}

void Grbl::restore(std::string_view what) {
    if (!is_quiet()) { return refuse(Error::NotIdle); }
    if (what != "$" && what != "#" && what != "*") { return refuse(Error::UnknownCommand); }
    if (what != "#") { options_ = {}; }
    Request& request = ask(what == "$" ? Request::Kind::DropSettings : Request::Kind::SetValues);
    request.values = {.tools = view_.values.tools};
    request.drops_settings = what == "*";
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
    refuse(Error::UnknownCommand, "this machine runs no blocks at its start");
}

void Grbl::write_setting(std::string_view text) {
    const std::size_t sign = text.find('=');
    if (sign == std::string_view::npos) { return refuse(Error::UnknownCommand); }
    const auto number = parse_number<int>(text.substr(0, sign));
    if (!number) { return refuse(Error::UnknownCommand); }
    const std::string_view word = text.substr(sign + 1);
    double value = 0;
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), value, std::chars_format::fixed);
    if (parsed.ec != std::errc{} || parsed.ptr != word.data() + word.size() || !std::isfinite(value)) {
        return refuse(Error::BadNumber);
    }
    keep_setting(*number, value);
}

void Grbl::keep_setting(int number, double value) {
    const auto written = grbl::write_setting(next_machine_, number, value, options_);
    if (!written) { return refuse(written.error().error, written.error().text); }
    if (written->empty()) { return ok(); }
    if (!is_quiet()) { return refuse(Error::NotIdle); }
    Request& request = ask(Request::Kind::KeepSettings);
    request.settings = *written;
    waits_for_ = request.number;
    before_ok_ = fmt::format("[MSG:${} is stored and {}]", number, kInForce);
}

/// Prints the settings as written, and names those that are not in force yet.
void Grbl::print_settings() {
    const auto in_force = settings_of(machine_, options_);
    std::string later;
    for (const Setting& setting : settings_of(next_machine_, options_)) {
        const std::string name = fmt::format("${}", setting.number);
        say(name + "=" + setting.value);
        const auto now = std::ranges::find(in_force, setting.number, &Setting::number);
        if (now->value != setting.value) { later += name + " "; }
    }
    if (!later.empty()) { say_message(later + kInForce); }
    ok();
}

void Grbl::print_parameters() {
    const auto places_of = [&](const gcode::Point& point) {
        std::vector<double> places;
        for (const AxisConfig& axis : machine_.axes) {
            const auto letter = gcode::axis_place(axis.name);
            places.push_back(letter ? point[*letter] : 0);
        }
        return places_text(places, options_.inches);
    };
    std::vector<double> park;
    for (const AxisConfig& axis : machine_.axes) { park.push_back(axis.homing.park_mm); }
    const gcode::KeptValues& values = view_.values;
    for (int i = 0; i < 6; ++i) {
        say(fmt::format("[G{}:{}]", 54 + i, places_of(values.systems[static_cast<std::size_t>(i)].origin)));
    }
    const auto home_of = [&](const std::optional<gcode::Point>& place) {
        return place ? places_of(*place) : places_text(park, options_.inches);
    };
    say("[G28:" + home_of(values.home) + "]");
    say("[G30:" + home_of(values.second_home) + "]");
    say("[G92:" + places_of(values.g92_applies ? values.g92 : gcode::Point{}) + "]");
    say("[TLO:" + places_text({lines_.tool_length_mm()}, options_.inches) + "]");
    say("[PRB:" + (view_.probe ? probe_text(*view_.probe) : places_of({}) + ":0") + "]");
    ok();
}

void Grbl::print_build() {
    say("[VER:1.1h.20190830:Lockstep " + version_ + "]");
    say(fmt::format("[OPT:NH,{},{}]", kPlannerLines, kMaxWaiting));
    ok();
}

}  // namespace lockstep::grbl
