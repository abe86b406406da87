#include "clients/session/upload/program_upload.hpp"

#include <utility>

#include "clients/session/follow/command_tracker.hpp"
#include "clients/session/follow/random_identity.hpp"

namespace lockstep {

ProgramSender& ProgramUpload::open(const ProgramHead& head, const std::optional<gcode::ProgramValues>& values,
                                   Feed feed) {
    const std::uint64_t id = random_identity() | 1;  // never 0, which means none
    feed_ = std::move(feed);
    answered_.reset();
    received_.reset();
    return sender_.emplace(client_, ++programs_, id, head, values);
}

void ProgramUpload::close() {
    feed_ = {};
    sender_.reset();
}

std::vector<ProgramChunk> ProgramUpload::due(std::chrono::nanoseconds now) {
    if (!sender_) { return {}; }
    if (feed_ && !sender_->is_ended() && sender_->free_blocks() > 0) { feed_(*sender_); }
    return sender_->due(now);
}

bool ProgramUpload::take_answer(const Reply& reply, std::chrono::nanoseconds now) {
    const bool is_of_program = sender_ && sender_->take_answer(reply);
    if (is_of_program) { answered_ = now; }
    return is_of_program;
}

bool ProgramUpload::is_overdue(const OwnerSight& owner, std::chrono::nanoseconds now) {
    if (!answered_) { answered_ = now; }
    if (!received_ || !owner.is_silent) { received_ = now; }
    return now - *answered_ > CommandTracker::kPlanPatience || now - *received_ > CommandTracker::kPatience;
}

}  // namespace lockstep
