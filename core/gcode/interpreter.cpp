#include "core/gcode/interpreter.hpp"

#include <algorithm>
#include <cmath>

#include "core/axis_unit.hpp"
#include "core/number_text.hpp"

namespace lockstep {
namespace {

constexpr double kMillimetresPerInch = 25.4;
constexpr double kSecondsPerMinute = 60;
constexpr std::string_view kWordLetters = "GMFPN";

/// ' ' for an axis that no letter calls.
char letter_of(const GcodeAxis& axis) {
    if (axis.name.size() != 1) { return ' '; }
    const char c = axis.name[0];
    const char letter = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return kWordLetters.find(letter) == std::string_view::npos ? letter : ' ';
}

}  // namespace

std::string axis_letters(const GcodeSetup& setup) {
    std::string letters;
    for (const GcodeAxis& axis : setup.axes) {
        if (letter_of(axis) != ' ') { letters += letter_of(axis); }
    }
    return letters;
}

GcodeInterpreter::GcodeInterpreter(const GcodeSetup& setup) : setup_(setup), offset_(setup.axes.size()) {
    program_.name = setup.program_name;
    for (const GcodeAxis& axis : setup.axes) {
        program_.axes.push_back(axis.name);
        program_.start_mm.push_back(axis.start_mm);
    }
    position_ = program_.start_mm;
}

void GcodeInterpreter::execute(const GcodeBlock& block, int line) {
    units_ = block.units.value_or(units_);
    distance_ = block.distance.value_or(distance_);
    if (block.feed) { set_feed(*block.feed, line); }
    if (block.motion) { motion_ = block.motion; }
    immediate(block, line);
    const bool axes_are_taken =
        block.immediate == gcode::Immediate::Park || block.immediate == gcode::Immediate::SetOffset;
    if (!block.axes.empty() && !axes_are_taken) { motion(block, line); }
    if (block.stop) { stop(*block.stop, line); }
}

ModalState GcodeInterpreter::modal_state() const {
    ModalState state{.inches = units_ == gcode::Units::Inches,
                     .relative = distance_ == gcode::Distance::Relative,
                     .feed_mm_min = {},
                     .offset_mm = offset_};
    if (feed_) { state.feed_mm_min = feed_->linear_mm_s * kSecondsPerMinute; }
    return state;
}

void GcodeInterpreter::set_feed(const GcodeWord& word, int line) {
    const double scale = units_ == gcode::Units::Inches ? kMillimetresPerInch : 1;
    if (word.value < kMinFeedPerMinute) {
        report(
            {line, word.column, word.text + " is too slow; F is per minute, from " + number_text(kMinFeedPerMinute)});
    }
    feed_ = Feed{.linear_mm_s = word.value * scale / kSecondsPerMinute, .rotary_deg_s = word.value / kSecondsPerMinute};
}

void GcodeInterpreter::immediate(const GcodeBlock& block, int line) {
    if (!block.immediate) { return; }
    switch (*block.immediate) {
        case gcode::Immediate::Dwell: return append(line, Dwell{block.dwell_seconds});
        case gcode::Immediate::Park: return park(block, line);
        case gcode::Immediate::SetOffset: return set_offsets(block);
        case gcode::Immediate::ClearOffset: offset_.assign(offset_.size(), 0); return;
    }
}

void GcodeInterpreter::park(const GcodeBlock& block, int line) {
    move_to(target_of(block, line), true, line);
    Point target = position_;
    for (std::size_t axis = 0; axis < target.size(); ++axis) {
        const bool named = std::ranges::any_of(block.axes, [&](const GcodeWord& w) { return axis_of(w) == axis; });
        if (named || block.axes.empty()) { target[axis] = setup_.axes[axis].park_mm; }
    }
    move_to(target, true, line);
}

void GcodeInterpreter::set_offsets(const GcodeBlock& block) {
    for (const GcodeWord& word : block.axes) {
        const std::size_t axis = axis_of(word);
        offset_[axis] = position_[axis] - to_mm(word);
    }
}

void GcodeInterpreter::motion(const GcodeBlock& block, int line) {
    if (!motion_) {
        const GcodeWord& word = block.axes.front();
        return report(
            {line, word.column, word.text + " but no motion mode; write G0 or G1 before the first axis word"});
    }
    const bool rapid = *motion_ == gcode::Motion::Rapid;
    if (!rapid && !feed_ && !missing_feed_reported_) {
        missing_feed_reported_ = true;
        report({line, block.axes.front().column, "G1 without a feed; write F, per minute, here or before"});
    }
    move_to(target_of(block, line), rapid, line);
}

void GcodeInterpreter::stop(gcode::Stop stop, int line) {
    const bool pauses =
        stop == gcode::Stop::Pause || (stop == gcode::Stop::OptionalPause && setup_.switches.pause_at_m1);
    if (pauses) { append(line, Pause{}); }
}

std::size_t GcodeInterpreter::axis_of(const GcodeWord& word) const {
    const auto found = std::ranges::find(setup_.axes, word.letter, letter_of);
    return static_cast<std::size_t>(found - setup_.axes.begin());
}

bool GcodeInterpreter::is_rotary(std::size_t axis) const { return lockstep::is_rotary(setup_.axes[axis].name); }

double GcodeInterpreter::to_mm(const GcodeWord& word) const {
    const bool inches = units_ == gcode::Units::Inches && !is_rotary(axis_of(word));
    return inches ? word.value * kMillimetresPerInch : word.value;
}

GcodeInterpreter::Point GcodeInterpreter::target_of(const GcodeBlock& block, int line) {
    Point target = position_;
    for (const GcodeWord& word : block.axes) {
        const std::size_t axis = axis_of(word);
        const double from = distance_ == gcode::Distance::Relative ? position_[axis] : offset_[axis];
        target[axis] = within_travel(word, from + to_mm(word), line);
    }
    return target;
}

/// What lies outside is reported and returned as it is: the lines after are then judged by what they mean.
double GcodeInterpreter::within_travel(const GcodeWord& word, double mm, int line) {
    const GcodeAxis& axis = setup_.axes[axis_of(word)];
    const double nearest = std::clamp(mm, axis.min_mm, axis.max_mm);
    if (std::abs(mm - nearest) <= kTravelTolerance_mm) { return nearest; }
    const std::string unit(unit_of(axis.name));
    report({line, word.column,
            word.text + " takes " + axis.name + " to " + number_text(mm) + " " + unit + ", outside its travel of " +
                number_text(axis.min_mm) + " to " + number_text(axis.max_mm) + " " + unit +
                " (machine coordinates); change the program, or the axis's " +
                (mm < nearest ? "position_min_mm" : "position_max_mm")});
    return mm;
}

/// A program's feed is along the path of all axes; this is the one that makes the linear ones go at F.
double GcodeInterpreter::feed_along_path(const Point& target) const {
    double linear = 0;
    double rotary = 0;
    for (std::size_t axis = 0; axis < target.size(); ++axis) {
        double& length = is_rotary(axis) ? rotary : linear;
        length = std::hypot(length, target[axis] - position_[axis]);
    }
    const Feed feed = feed_.value_or(Feed{});
    if (linear <= kTravelTolerance_mm) { return feed.rotary_deg_s; }
    return std::min(feed.linear_mm_s * (std::hypot(linear, rotary) / linear), kMaxFeed_mm_s);
}

void GcodeInterpreter::move_to(const Point& target, bool rapid, int line) {
    if (target == position_) { return; }
    append(line, LinearMove{.target_mm = target, .feed_mm_s = rapid ? 0 : feed_along_path(target), .rapid = rapid});
    position_ = target;
}

void GcodeInterpreter::append(int line, decltype(Block::action) action) {
    if (program_.blocks.size() < kMaxProgramBlocks) {
        program_.blocks.push_back({.line = line, .action = std::move(action)});
        return;
    }
    report({line, 1, "the program has more than " + std::to_string(kMaxProgramBlocks) + " blocks; cut it in two"});
}

}  // namespace lockstep
