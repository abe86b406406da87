#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "core/if_positive.hpp"
#include "core/machine.hpp"
#include "core/number_text.hpp"
#include "services/documents/names.hpp"
#include "services/documents/program_document.hpp"
#include "services/documents/program_proto.hpp"

namespace lockstep {
namespace {

using Refusal = std::optional<std::string>;
using Numbers = google::protobuf::RepeatedField<double>;

std::string at_most(std::size_t value, std::size_t limit) {
    return fmt::format("{}; it must be at most {}", value, limit);
}

Refusal check_axes(const proto::Program& message) {
    const auto& axes = message.axes();
    if (axes.empty()) { return "the program names no axis"; }
    const auto count = static_cast<std::size_t>(axes.size());
    if (count > kMaxAxes) { return "the program's number of axes is " + at_most(count, kMaxAxes); }
    for (int i = 0; i < axes.size(); ++i) {
        if (!is_axis_name(axes[i])) { return fmt::format("axis {} of the program has no valid name", i + 1); }
        for (int other = 0; other < i; ++other) {
            if (same_name(axes[i], axes[other])) { return "the program names axis " + axes[i] + " twice"; }
        }
    }
    return {};
}

Refusal check_places(const Numbers& places, const proto::Program& message, std::size_t axes) {
    if (static_cast<std::size_t>(places.size()) != axes) {
        return fmt::format("has {} positions for {} axes", places.size(), axes);
    }
    for (int i = 0; i < places.size(); ++i) {
        if (!(std::abs(places[i]) <= kMaxPlace_mm)) {
            const std::string axis = i < message.axes_size() ? message.axes(i) : fmt::format("axis {}", i + 1);
            return fmt::format("puts {} at {} mm; it must be from -{} to {} mm", axis, number_text(places[i]),
                               number_text(kMaxPlace_mm), number_text(kMaxPlace_mm));
        }
    }
    return {};
}

Refusal check_head(const proto::Program& message) {
    if (message.name().size() > kMaxProgramName) {
        return "the length of the program's name is " + at_most(message.name().size(), kMaxProgramName);
    }
    if (Refusal refusal = check_axes(message)) { return refusal; }
    const auto axes = static_cast<std::size_t>(message.axes_size());
    if (Refusal refusal = check_places(message.start_mm(), message, axes)) { return "the start " + *refusal; }
    return {};
}

Refusal check_arc(const proto::ProgramMove& move, std::size_t axes) {
    const proto::ArcShape& arc = move.arc();
    if (move.rapid()) { return "an arc is rapid; it needs a feed"; }
    if (arc.first() >= axes || arc.second() >= axes || arc.first() == arc.second()) {
        return fmt::format("the arc's plane has axes {} and {}; they must be two different axes of {}", arc.first(),
                           arc.second(), axes);
    }
    for (const double mm : {arc.centre_first_mm(), arc.centre_second_mm()}) {
        if (!(std::abs(mm) <= kMaxCentre_mm)) {
            return fmt::format("the arc's centre is at {} mm; it must be from -{} to {} mm", number_text(mm),
                               number_text(kMaxCentre_mm), number_text(kMaxCentre_mm));
        }
    }
    if (arc.turns() < 1 || arc.turns() > kMaxTurns) {
        return fmt::format("the arc's number of turns is {}; it must be from 1 to {}", arc.turns(), kMaxTurns);
    }
    return {};
}

Refusal check_move(const proto::ProgramMove& move, const proto::Program& message, std::size_t axes) {
    if (Refusal refusal = check_places(move.target_mm(), message, axes)) { return "the target " + *refusal; }
    if (!move.rapid() && !(move.feed_mm_s() >= kLeastSpeed_mm_s && move.feed_mm_s() <= kMaxFeed_mm_s)) {
        return fmt::format("the feed is {} mm/s; it must be from {} to {}", number_text(move.feed_mm_s()),
                           number_text(kLeastSpeed_mm_s), number_text(kMaxFeed_mm_s));
    }
    if (!proto::PathMode_IsValid(move.mode())) { return fmt::format("the path mode is unknown: {}", int{move.mode()}); }
    if (!(move.tolerance_mm() >= 0 && move.tolerance_mm() <= kMaxTolerance_mm)) {
        return fmt::format("the tolerance is {} mm; it must be from 0 to {}", number_text(move.tolerance_mm()),
                           number_text(kMaxTolerance_mm));
    }
    return move.has_arc() ? check_arc(move, axes) : Refusal{};
}

Refusal check_event(const proto::ProgramEvent& event) {
    if (!proto::ProgramEvent::Kind_IsValid(event.kind())) {
        return fmt::format("the event's kind is unknown: {}", int{event.kind()});
    }
    if (event.index() < 0 || event.index() > kMaxEventIndex) {
        return fmt::format("the event's index is {}; it must be from 0 to {}", event.index(), kMaxEventIndex);
    }
    if (!std::isfinite(event.value())) { return "the event's value is not a number"; }
    return {};
}

Refusal check_wait(const proto::InputWait& wait) {
    if (!proto::InputWait::Mode_IsValid(wait.mode())) {
        return fmt::format("the mode of the wait for an input is unknown: {}", int{wait.mode()});
    }
    if (!(wait.seconds() > 0 && wait.seconds() <= kMaxDwell_s)) {
        return fmt::format("the wait for an input is {} s; it must be above 0 and at most {}",
                           number_text(wait.seconds()), number_text(kMaxDwell_s));
    }
    return {};
}

Refusal check_pause(const proto::Pause& pause) {
    if (!proto::Pause::Reason_IsValid(pause.reason())) {
        return fmt::format("the pause's reason is unknown: {}", int{pause.reason()});
    }
    if (pause.tool() < 0 || pause.tool() > kMaxTool) {
        return fmt::format("the pause's tool is {}; it must be from 0 to {}", pause.tool(), kMaxTool);
    }
    if (pause.text().size() > kMaxPauseText) {
        return "the length of the pause's text is " + at_most(pause.text().size(), kMaxPauseText);
    }
    if (pause.text() != pause_text(pause.text())) { return "the pause's text is not printable ASCII"; }
    if (pause.has_wait() != (pause.reason() == proto::Pause::INPUT)) {
        return "a pause has a wait for an input exactly if this is its reason";
    }
    if (pause.has_wait()) { return check_wait(pause.wait()); }
    return {};
}

Refusal check_block(const proto::Block& block, const proto::Program& message, std::size_t axes) {
    if (block.line() < 0) { return fmt::format("the line is {}; lines are numbered from 1", block.line()); }
    if (block.has_move()) { return check_move(block.move(), message, axes); }
    if (block.has_event()) { return check_event(block.event()); }
    if (block.has_dwell() && !(block.dwell().seconds() >= 0 && block.dwell().seconds() <= kMaxDwell_s)) {
        return fmt::format("the dwell is {} s; it must be from 0 to {}", number_text(block.dwell().seconds()),
                           number_text(kMaxDwell_s));
    }
    if (block.has_pause()) { return check_pause(block.pause()); }
    if (block.action_case() == proto::Block::ACTION_NOT_SET) { return "the action is missing or unknown"; }
    return {};
}

std::optional<ArcShape> read_arc(const proto::ProgramMove& move) {
    if (!move.has_arc()) { return std::nullopt; }
    const proto::ArcShape& arc = move.arc();
    return ArcShape{.first = arc.first(),
                    .second = arc.second(),
                    .centre_first_mm = arc.centre_first_mm(),
                    .centre_second_mm = arc.centre_second_mm(),
                    .is_clockwise = arc.clockwise(),
                    .turns = arc.turns()};
}

std::optional<InputWait> read_wait(const proto::Pause& pause) {
    if (!pause.has_wait()) { return std::nullopt; }
    return InputWait{pause.wait().input(), static_cast<InputMode>(pause.wait().mode()), pause.wait().seconds()};
}

Block read_block(const proto::Block& message) {
    Block block{.line = if_positive(message.line()), .action = Pause{}};
    if (message.has_move()) {
        const proto::ProgramMove& move = message.move();
        block.action = ProgramMove{.target_mm = {move.target_mm().begin(), move.target_mm().end()},
                                   .feed_mm_s = move.rapid() ? 0 : move.feed_mm_s(),
                                   .rapid = move.rapid(),
                                   .arc = read_arc(move),
                                   .mode = static_cast<PathMode>(move.mode()),
                                   .tolerance_mm = move.tolerance_mm(),
                                   .is_feed_fixed = move.feed_fixed()};
    } else if (message.has_dwell()) {
        block.action = Dwell{message.dwell().seconds()};
    } else if (message.has_pause()) {
        const proto::Pause& pause = message.pause();
        block.action = Pause{static_cast<PauseReason>(pause.reason()), pause.tool(), pause.text(), read_wait(pause)};
    } else if (message.has_settle()) {
        block.action = Settle{};
    } else if (message.has_probe()) {
        block.action = Probe{message.probe().input(), message.probe().opens(), !message.probe().may_miss()};
    } else if (message.has_event()) {
        const proto::ProgramEvent& event = message.event();
        block.action = ProgramEvent{static_cast<ProgramEvent::Kind>(event.kind()), event.index(), event.value()};
    }
    return block;
}

}  // namespace

std::expected<Program, std::string> program_from_proto(const proto::Program& message, std::optional<std::size_t> axes) {
    if (const auto blocks = static_cast<std::size_t>(message.blocks_size()); blocks > kMaxProgramBlocks) {
        return std::unexpected("the program's number of blocks is " + at_most(blocks, kMaxProgramBlocks));
    }
    if (axes && message.axes_size() > 0) { return std::unexpected("a later part of a program names axes"); }
    Refusal refused = axes ? Refusal{} : check_head(message);
    if (refused) { return std::unexpected(*refused); }
    const std::size_t places = axes.value_or(static_cast<std::size_t>(message.axes_size()));
    Program program{.name = message.name(),
                    .axes = {message.axes().begin(), message.axes().end()},
                    .start_mm = {message.start_mm().begin(), message.start_mm().end()},
                    .blocks = {}};
    program.blocks.reserve(static_cast<std::size_t>(message.blocks_size()));
    for (const proto::Block& block : message.blocks()) {
        if (Refusal refusal = check_block(block, message, places)) {
            return std::unexpected(fmt::format("block {}: {}", program.blocks.size() + 1, *refusal));
        }
        program.blocks.push_back(read_block(block));
    }
    return program;
}

}  // namespace lockstep
