#include "clients/merge/job_program.hpp"

#include <algorithm>

#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/lcm_decode.hpp"

namespace lockstep::merge {

bool JobProgram::takes(const HeldMessage& message) {
    if (!program_ || message.is_foreign || kind_of(message.id.channel) != RecordKind::ProgramPart) { return false; }
    const auto part = decode_lcm<program_part_t>(message.data);
    const bool is_its =
        part && part->job == 0 && part->coordinator == program_->coordinator && part->program == program_->program;
    if (!is_its || !sequences_.insert(part->sequence).second) { return false; }
    parts_ = std::max<std::int64_t>(parts_, part->parts);
    came_.insert(part->part);
    return true;
}

std::int64_t JobProgram::missing() const {
    return program_ && parts_ > 0 ? parts_ - static_cast<std::int64_t>(came_.size()) : 0;
}

}  // namespace lockstep::merge
