#include "services/documents/program_proto.hpp"

namespace lockstep {
namespace {

struct ActionWriter {
    proto::Block& block;

    void operator()(const LinearMove& move) const {
        proto::LinearMove& message = *block.mutable_move();
        message.mutable_target_mm()->Assign(move.target_mm.begin(), move.target_mm.end());
        message.set_rapid(move.rapid);
        if (!move.rapid) { message.set_feed_mm_s(move.feed_mm_s); }
    }
    void operator()(const Dwell& dwell) const { block.mutable_dwell()->set_seconds(dwell.seconds); }
    void operator()(const Pause&) const { block.mutable_pause(); }
    void operator()(const Settle&) const { block.mutable_settle(); }
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
    if (block.line > 0) { message.set_line(block.line); }
    std::visit(ActionWriter{message}, block.action);
}

}  // namespace lockstep
