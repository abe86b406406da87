#include "services/documents/program_proto.hpp"

namespace lockstep {
namespace {

static_assert(static_cast<int>(PathMode::ExactStop) == proto::EXACT_STOP && proto::PathMode_ARRAYSIZE == 3);
static_assert(static_cast<int>(ProgramEvent::Kind::Tool) == proto::ProgramEvent::TOOL &&
              kEventWords.size() == proto::ProgramEvent::Kind_ARRAYSIZE);

static_assert(static_cast<int>(PauseReason::PalletChange) == proto::Pause::PALLET_CHANGE);
static_assert(static_cast<int>(PauseReason::Input) == proto::Pause::INPUT);  // Hold is not of a program
static_assert(static_cast<int>(InputMode::IsOpen) == proto::InputWait::IS_OPEN);

struct ActionWriter {
    proto::Block& block;

    void operator()(const ProgramMove& move) const {
        proto::ProgramMove& message = *block.mutable_move();
        message.mutable_target_mm()->Assign(move.target_mm.begin(), move.target_mm.end());
        message.set_rapid(move.rapid);
        if (!move.rapid) { message.set_feed_mm_s(move.feed_mm_s); }
        if (move.arc) { write(*move.arc, *message.mutable_arc()); }
        message.set_mode(static_cast<proto::PathMode>(move.mode));
        message.set_tolerance_mm(move.tolerance_mm);
        message.set_feed_fixed(move.is_feed_fixed);
    }
    void operator()(const Dwell& dwell) const { block.mutable_dwell()->set_seconds(dwell.seconds); }
    void operator()(const Pause& pause) const {
        proto::Pause& message = *block.mutable_pause();
        message.set_reason(static_cast<proto::Pause::Reason>(pause.reason));
        message.set_tool(pause.tool);
        message.set_text(pause.text);
        if (!pause.wait) { return; }
        message.mutable_wait()->set_input(pause.wait->input);
        message.mutable_wait()->set_mode(static_cast<proto::InputWait::Mode>(pause.wait->mode));
        message.mutable_wait()->set_seconds(pause.wait->seconds);
    }
    void operator()(const Settle&) const { block.mutable_settle(); }
    void operator()(const Probe& probe) const {
        proto::Probe& message = *block.mutable_probe();
        message.set_input(probe.input);
        message.set_opens(probe.opens);
        message.set_may_miss(!probe.must_touch);
    }
    void operator()(const ProgramEvent& event) const {
        proto::ProgramEvent& message = *block.mutable_event();
        message.set_kind(static_cast<proto::ProgramEvent::Kind>(event.kind));
        message.set_index(event.index);
        message.set_value(event.value);
    }

    static void write(const ArcShape& arc, proto::ArcShape& message) {
        message.set_first(static_cast<std::uint32_t>(arc.first));
        message.set_second(static_cast<std::uint32_t>(arc.second));
        message.set_centre_first_mm(arc.centre_first_mm);
        message.set_centre_second_mm(arc.centre_second_mm);
        message.set_clockwise(arc.is_clockwise);
        message.set_turns(arc.turns);
    }
};

}  // namespace

proto::Program program_to_proto(const Program& program) {
    proto::Program message;
    message.set_name(program.name);
    for (const std::string& axis : program.axes) { message.add_axes(axis); }
    message.mutable_start_mm()->Assign(program.start_mm.begin(), program.start_mm.end());
    for (const Block& block : program.blocks) { block_to_proto(block, *message.add_blocks()); }
    return message;
}

void block_to_proto(const Block& block, proto::Block& message) {
    if (block.line) { message.set_line(*block.line); }
    std::visit(ActionWriter{message}, block.action);
}

}  // namespace lockstep
