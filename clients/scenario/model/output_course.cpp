#include "clients/scenario/model/output_course.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/number_text.hpp"

namespace lockstep::scenario {
namespace {

Ticks ticks_of(double ms, const MachineConfig& machine) {
    return Ticks{std::llround(ms * 1e-3 * machine.ticks_per_second())};
}

std::string ms_text(Ticks time, const MachineConfig& machine) {
    return fmt::format("{:.1f} ms", machine.microseconds(time) * 1e-3);
}

const char* name_of_level(bool on) { return on ? "on" : "off"; }

/// The level at a time: that of the last change before it. An output is off when its device powers up.
OutputLevel level_at(const std::vector<OutputLevel>& course, Tick at) {
    OutputLevel level;
    for (const OutputLevel& next : course) {
        if (next.from > at) { break; }
        level = next;
    }
    return level;
}

/// Until when the record has all changes of the motor's outputs: its process reads them before it reports its position.
Tick known_until(const RecordFacts& facts, const std::string& motor) {
    const auto last = facts.last_position.find(motor);
    return last == facts.last_position.end() ? Tick{} : last->second;
}

FoundOutput keeps(const std::vector<OutputLevel>& course, const MachineConfig& machine, Tick act, Tick end) {
    const OutputLevel before = level_at(course, act);
    const auto changed = std::ranges::find_if(course, [&](const OutputLevel& level) {
        return level.from > act && level.from <= end && level.on != before.on;
    });
    if (changed == course.end()) { return {true, fmt::format("it stays {}", name_of_level(before.on)), end}; }
    return {false, fmt::format("{} after {}", name_of_level(changed->on), ms_text(changed->from - act, machine)),
            changed->from};
}

FoundOutput goes_off(const Asked::OutputAfter& asked, const std::vector<OutputLevel>& course,
                     const MachineConfig& machine, Tick act, Tick end) {
    if (!level_at(course, act).on) { return {false, "it is off already", act}; }
    const OutputLevel last = level_at(course, end);
    if (last.on) { return {false, "it is on", end}; }
    const std::string found = "off after " + ms_text(last.from - act, machine);
    return {last.from - act >= ticks_of(asked.off_not_before_ms(), machine), found, last.from};
}

}  // namespace

std::vector<OutputLevel> course_of(const OutputConfig& output, const RecordFacts& facts) {
    std::vector<OutputLevel> course;
    const auto changes = facts.channels.find(output.motor);
    if (changes == facts.channels.end()) { return course; }
    for (const auto& [at, event] : changes->second) {
        const bool is_digital = event.kind == ChannelEvent::Kind::Digital && !output.is_analog();
        const bool is_analog =
            event.kind == ChannelEvent::Kind::Analog && output.is_analog() && event.channel == output.channel;
        if (!is_digital && !is_analog) { continue; }
        const bool on = is_digital ? (event.levels & output.bit()) != 0 : event.value > 0 || event.detail > 0;
        if (course.empty() ? on : course.back().on != on) { course.push_back({at, on}); }
    }
    return course;
}

FoundOutput output_after(const Asked::OutputAfter& asked, const MachineConfig& machine, const RecordFacts& facts,
                         Tick act) {
    const auto output = std::ranges::find(machine.outputs, asked.name(), &OutputConfig::name);
    const double ms = asked.has_off_within_ms() ? asked.off_within_ms() : asked.keeps_for_ms();
    const Tick end = act + ticks_of(ms, machine);
    const Tick known = known_until(facts, output->motor);
    if (known < end) {
        return {false,
                fmt::format("the record of {} ends {} before that; restart its process, so that it reads what its "
                            "device noted, or wait longer",
                            output->motor, ms_text(end - known, machine)),
                known};
    }
    const std::vector<OutputLevel> course = course_of(*output, facts);
    return asked.has_off_within_ms() ? goes_off(asked, course, machine, act, end) : keeps(course, machine, act, end);
}

std::string text_of(const Asked::OutputAfter& asked) {
    std::string text = asked.name();
    if (asked.has_off_within_ms()) { text += " off within " + number_text(asked.off_within_ms()) + " ms"; }
    if (asked.has_off_not_before_ms()) { text += ", not before " + number_text(asked.off_not_before_ms()) + " ms"; }
    if (asked.has_keeps_for_ms()) { text += " keeps its level for " + number_text(asked.keeps_for_ms()) + " ms"; }
    return text;
}

}  // namespace lockstep::scenario
