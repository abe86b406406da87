// Words that move no axis: messages, spindle, tools, outputs, coolant, overrides, dwells and stops.
#include <algorithm>
#include <array>

#include "core/gcode/run/compensation.hpp"
#include "core/gcode/run/steps.hpp"
#include "core/number_text.hpp"
#include "core/program.hpp"

namespace lockstep::gcode {
namespace {

std::string small(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return result;
}

/// The value of the parameter at the beginning of a text, behind its #. Removes the parameter from the text.
std::string take_parameter(const Context& context, std::string_view& text) {
    constexpr std::string_view kUnknown = "######";
    if (text.starts_with('<')) {
        const std::size_t end = text.find('>');
        if (end == std::string_view::npos) { return "#"; }
        std::string name = small(text.substr(1, end - 1));
        std::erase_if(name, [](char c) { return c == ' ' || c == '\t'; });
        text.remove_prefix(end + 1);
        const auto value = context.parameters.named(name);
        return value ? std::to_string(*value) : std::string(kUnknown);
    }
    int number = 0;
    std::size_t digits = 0;
    while (digits < text.size() && text[digits] >= '0' && text[digits] <= '9' && number <= kMaxParameter) {
        number = number * 10 + (text[digits++] - '0');
    }
    if (digits == 0) { return "#"; }
    text.remove_prefix(digits);
    const bool known = number >= 1 && number <= kMaxParameter;
    return known ? std::to_string(context.parameters.numbered(number)) : std::string(kUnknown);
}

/// The index of an output: P, or E of an analog one.
std::expected<int, GcodeError> output_index(const Context& context, char letter) {
    if (!context.block.has(letter)) {
        return context.refuse(Group::Output, std::string(" names no output; write ") + letter + " and its number");
    }
    const auto index = whole(context.block[letter]);
    if (!index || *index < 0) {
        return context.refuse(letter, " is not an output's number; it must be a whole number from 0");
    }
    return *index;
}

/// A word that switches an output: P or E names the output. Those with E have a value, Q.
struct OutputWord {
    int code;  // of M, times ten
    ProgramEvent::Kind switched;
    char letter;
};
constexpr std::array kOutputWords{
    OutputWord{620, ProgramEvent::Kind::OutputOn, 'P'},     OutputWord{630, ProgramEvent::Kind::OutputOff, 'P'},
    OutputWord{640, ProgramEvent::Kind::OutputOn, 'P'},     OutputWord{650, ProgramEvent::Kind::OutputOff, 'P'},
    OutputWord{670, ProgramEvent::Kind::AnalogOutput, 'E'}, OutputWord{680, ProgramEvent::Kind::AnalogOutput, 'E'},
};

Result switch_output(const Context& context, const OutputWord& word) {
    const auto index = output_index(context, word.letter);
    if (!index) { return std::unexpected(index.error()); }
    const bool has_value = word.letter == 'E';
    if (has_value && !context.block.has('Q')) {
        return context.refuse(Group::Output, " has no value; write Q and the value");
    }
    context.emit(Event{.kind = EventKind::Output,
                       .index = *index,
                       .value = has_value ? context.block['Q'] : 0,
                       .text = {},
                       .switched = word.switched});
    return {};
}

Result wait_for_input(const Context& context) {
    const LineWords& block = context.block;
    if (block.has('P') == block.has('E')) {
        return context.refuse(Group::Output, " waits for one input; write P or E and its number");
    }
    const auto index = output_index(context, block.has('P') ? 'P' : 'E');
    if (!index) { return std::unexpected(index.error()); }
    const int kind = whole(block.find('L').value_or(0)).value_or(-1);
    if (kind < 0 || kind > 4) { return context.refuse('L', " is not a wait mode; L must be 0 to 4"); }
    if (kind != 0 && block.has('E')) {
        return context.refuse('L', " is not possible for an analog input, which is read at once; write L0");
    }
    const double seconds = block.find('Q').value_or(0);
    if (kind != 0 && !(seconds > 0)) {
        return context.refuse(Group::Output, " has no time limit; write Q and the seconds");
    }
    if (seconds > kMaxDwell_s) {
        return context.refuse('Q', " s is too long a wait; Q must be at most " + number_text(kMaxDwell_s) + " s");
    }
    context.emit(Event{EventKind::InputWait, *index, seconds, {}, kind, block.has('E')});
    return {};
}

Result pulses_at_places(const Context& context) {
    const LineWords& block = context.block;
    const auto index = output_index(context, 'P');
    if (!index) { return std::unexpected(index.error()); }
    const bool has_places = block.has('Q') || block.has('R') || block.has('L');
    if (!has_places) {
        context.event(EventKind::Pulses, *index);
        return {};
    }
    if (!block.has('Q') || !block.has('R') || !block.has('L')) {
        return context.refuse(Group::Output,
                              " needs all of Q, the first place, R, the way from each to the next, and L, "
                              "how many; without them it ends the pulses");
    }
    const int count = whole(block['L']).value_or(0);
    if (count < 1 || count > kMaxEventIndex) {
        return context.refuse(
            'L', " is not a number of places; it must be a whole number from 1 to " + std::to_string(kMaxEventIndex));
    }
    if (block['R'] == 0) { return context.refuse('R', " puts all places into one; R must not be 0"); }
    context.emit(Event{.kind = EventKind::Pulses,
                       .index = *index,
                       .value = block['Q'],
                       .text = {},
                       .mode = count,
                       .spacing = block['R']});
    return {};
}

}  // namespace

std::string message_text(const Context& context, std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const char c = text.front();
        text.remove_prefix(1);
        result += c == '#' ? take_parameter(context, text) : std::string(1, c);
    }
    return result;
}

/// The text is of no effect, but it may tell a person what to do at a pause.
Result remark(Context& context, std::string_view text) {
    context.emit(Event{EventKind::Remark, 0, 0, std::string(text)});
    return {};
}

Result comment(Context& context) {
    if (!context.block.comment) { return {}; }
    const std::size_t begin = *context.block.comment + 1;
    const std::size_t end = context.line.end_of_comment(begin) - 1;
    std::string_view text = context.line.text().substr(begin, end - begin);
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos) { return remark(context, text); }
    const std::string_view whole_text = text;
    std::string kind = small(text.substr(0, comma));
    std::erase_if(kind, [](char c) { return c == ' ' || c == '\t'; });
    text.remove_prefix(comma + 1);
    if (kind == "msg") { context.emit(Event{EventKind::Message, 0, 0, std::string(text)}); }
    if (kind == "debug") { context.emit(Event{EventKind::Message, 0, 0, message_text(context, text)}); }
    if (kind == "print") { context.emit(Event{EventKind::Print, 0, 0, message_text(context, text)}); }
    if (kind != "msg" && kind != "debug" && kind != "print") { return remark(context, whole_text); }
    return {};
}

Result spindle_speed(Context& context) {
    const auto speed = context.block.find('S');
    if (!speed) { return {}; }
    if (*speed < 0) {
        return context.refuse('S', " is not a speed; S must be 0 or above; for the other direction write M4");
    }
    context.state.modal.spindle_speed = *speed;
    context.event(EventKind::SpindleSpeed, 0, *speed);
    return {};
}

Result outputs(Context& context) {
    const int code = context.block.code(Group::Output);
    if (code == LineWords::kNoCode) { return {}; }
    if (auto checked = context.refuse_compensated(Group::Output); !checked) { return checked; }
    if (code == 660) { return wait_for_input(context); }
    if (code == 690) { return pulses_at_places(context); }
    return switch_output(context, *std::ranges::find(kOutputWords, code, &OutputWord::code));
}

Result spindle(Context& context) {
    Modal& modal = context.state.modal;
    switch (context.block.code(Group::Spindle)) {
        case 30:
            modal.spindle = SpindleDirection::Forward;
            context.event(EventKind::SpindleForward);
            break;
        case 40:
            modal.spindle = SpindleDirection::Reverse;
            context.event(EventKind::SpindleReverse);
            break;
        case 50:
            modal.spindle = SpindleDirection::Stopped;
            context.event(EventKind::SpindleStop);
            break;
        default: break;
    }
    return {};
}

Result coolant(Context& context) {
    Modal& modal = context.state.modal;
    switch (context.block.code(Group::Coolant)) {
        case 70:
            modal.mist = true;
            context.event(EventKind::Mist);
            break;
        case 80:
            modal.flood = true;
            context.event(EventKind::Flood);
            break;
        case 90:
            modal.mist = modal.flood = false;
            context.event(EventKind::CoolantOff);
            break;
        default: break;
    }
    return {};
}

Result overrides(Context& context) {
    Modal& modal = context.state.modal;
    const int code = context.block.code(Group::Override);
    if (code == LineWords::kNoCode) { return {}; }
    if (auto checked = context.refuse_compensated(Group::Override); !checked) { return checked; }
    const bool on = code == 480 || (code != 490 && context.block.find('P').value_or(1) != 0);
    const auto set = [&](bool& value, EventKind kind) {
        value = on;
        context.event(kind, 0, on ? 1 : 0);
    };
    if (code <= 500) { set(modal.feed_override, EventKind::FeedOverride); }
    if (code <= 490 || code == 510) { set(modal.speed_override, EventKind::SpeedOverride); }
    if (code == 520) { set(modal.adaptive_feed, EventKind::AdaptiveFeed); }
    if (code == 530) { set(modal.feed_hold, EventKind::FeedHold); }
    return {};
}

Result dwell(Context& context) {
    if (context.block.code(Group::NonModal) != 40) { return {}; }
    const auto seconds = context.block.find('P');
    if (!seconds) { return context.refuse(Group::NonModal, " has no dwell time; write P and the seconds"); }
    if (*seconds < 0 || *seconds > kMaxDwell_s) {
        return context.refuse('P', " s is not a dwell; it must be from 0 to " + number_text(kMaxDwell_s) + " s");
    }
    context.emit(Dwell{*seconds});
    return {};
}

Result stop(Context& context) {
    State& state = context.state;
    switch (context.block.code(Group::Stop)) {
        case 0: context.event(EventKind::Stop); break;
        case 600: context.event(EventKind::PalletChange); break;
        case 10: context.event(EventKind::OptionalStop); break;
        case 20:
        case 300: {
            Modal after;  // RS274, 3.6.1: the end of a program resets all but these
            after.inches = state.modal.inches;
            after.spindle_speed = state.modal.spindle_speed;
            after.retract_to_start = state.modal.retract_to_start;
            after.path_mode = state.modal.path_mode;
            after.path_tolerance = state.modal.path_tolerance;
            after.centres_absolute = state.modal.centres_absolute;
            end_compensation(context);
            state.modal = after;
            begin_system(state, 0);
            context.event(EventKind::End);
            context.ended = true;
            break;
        }
        default: break;
    }
    return {};
}

}  // namespace lockstep::gcode
