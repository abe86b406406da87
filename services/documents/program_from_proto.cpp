#include <cmath>
#include <optional>

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
    return std::to_string(value) + "; at most " + std::to_string(limit);
}

Refusal check_axes(const proto::Program& message) {
    const auto& axes = message.axes();
    if (axes.empty()) { return "the program names no axis"; }
    const auto count = static_cast<std::size_t>(axes.size());
    if (count > kMaxAxes) { return "the program's number of axes is " + at_most(count, kMaxAxes); }
    for (int i = 0; i < axes.size(); ++i) {
        if (!is_axis_name(axes[i])) { return "axis " + std::to_string(i + 1) + " of the program has no axis's name"; }
        for (int other = 0; other < i; ++other) {
            if (same_name(axes[i], axes[other])) { return "the program names axis " + axes[i] + " twice"; }
        }
    }
    return {};
}

Refusal check_places(const Numbers& places, const proto::Program& message) {
    if (places.size() != message.axes_size()) {
        return "has " + std::to_string(places.size()) + " places for " + std::to_string(message.axes_size()) + " axes";
    }
    for (int i = 0; i < places.size(); ++i) {
        if (!(std::abs(places[i]) <= kMaxPlace_mm)) {
            return "puts " + message.axes(i) + " at " + number_text(places[i]) + " mm; places go to " +
                   number_text(kMaxPlace_mm) + " mm either way";
        }
    }
    return {};
}

Refusal check_head(const proto::Program& message) {
    if (message.name().size() > kMaxProgramName) {
        return "the length of the program's name is " + at_most(message.name().size(), kMaxProgramName);
    }
    const auto blocks = static_cast<std::size_t>(message.blocks_size());
    if (blocks > kMaxProgramBlocks) {
        return "the program's number of blocks is " + at_most(blocks, kMaxProgramBlocks);
    }
    if (Refusal refusal = check_axes(message)) { return refusal; }
    if (Refusal refusal = check_places(message.start_mm(), message)) { return "the start " + *refusal; }
    return {};
}

Refusal check_move(const proto::LinearMove& move, const proto::Program& message) {
    if (Refusal refusal = check_places(move.target_mm(), message)) { return "the target " + *refusal; }
    if (!move.rapid() && !(move.feed_mm_s() > 0 && move.feed_mm_s() <= kMaxFeed_mm_s)) {
        return "the feed is " + number_text(move.feed_mm_s()) + " mm/s; it is above 0, to " +
               number_text(kMaxFeed_mm_s);
    }
    return {};
}

Refusal check_block(const proto::Block& block, const proto::Program& message) {
    if (block.line() < 0) { return "the line is " + std::to_string(block.line()) + "; lines count from 1"; }
    if (block.has_move()) { return check_move(block.move(), message); }
    if (block.has_dwell() && !(block.dwell().seconds() >= 0 && block.dwell().seconds() <= kMaxDwell_s)) {
        return "the dwell is " + number_text(block.dwell().seconds()) + " s; it goes from 0 to " +
               number_text(kMaxDwell_s);
    }
    if (block.action_case() == proto::Block::ACTION_NOT_SET) { return "no action known here"; }
    return {};
}

Block read_block(const proto::Block& message) {
    Block block{.line = message.line(), .action = Pause{}};
    if (message.has_move()) {
        const proto::LinearMove& move = message.move();
        block.action = LinearMove{.target_mm = {move.target_mm().begin(), move.target_mm().end()},
                                  .feed_mm_s = move.rapid() ? 0 : move.feed_mm_s(),
                                  .rapid = move.rapid()};
    } else if (message.has_dwell()) {
        block.action = Dwell{message.dwell().seconds()};
    }
    return block;
}

}  // namespace

std::expected<Program, std::string> program_from_proto(const proto::Program& message) {
    if (Refusal refusal = check_head(message)) { return std::unexpected(*refusal); }
    Program program{.name = message.name(),
                    .axes = {message.axes().begin(), message.axes().end()},
                    .start_mm = {message.start_mm().begin(), message.start_mm().end()},
                    .blocks = {}};
    program.blocks.reserve(static_cast<std::size_t>(message.blocks_size()));
    for (const proto::Block& block : message.blocks()) {
        if (Refusal refusal = check_block(block, message)) {
            return std::unexpected("block " + std::to_string(program.blocks.size() + 1) + ": " + *refusal);
        }
        program.blocks.push_back(read_block(block));
    }
    return program;
}

}  // namespace lockstep
