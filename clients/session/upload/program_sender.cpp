#include "clients/session/upload/program_sender.hpp"

#include <algorithm>

#include "core/faults.hpp"

namespace lockstep {
namespace {

constexpr std::uint64_t kOfPrograms = std::uint64_t{1} << 63;  // commands have lower numbers

}  // namespace

ProgramSender::ProgramSender(Identity client, std::uint32_t number, std::uint64_t program, const ProgramHead& head,
                             const std::optional<gcode::ProgramValues>& values)
    : client_(client),
      first_sequence_(kOfPrograms | std::uint64_t{number & 0x7fffffff} << 32),
      program_(program),
      open_(head, values) {}

std::size_t ProgramSender::free_blocks() const {
    if (is_ended_ || refusal_ || parts_.size() >= kPartsWaiting) { return 0; }
    const std::size_t here = (kPartsWaiting - parts_.size()) * kPartBlocks - open_.blocks();
    return std::min<std::uint64_t>(here, room_ - std::min<std::uint64_t>(room_, waiting_));
}

void ProgramSender::append(const Block& block) {
    open_.add(block);
    ++waiting_;
    if (open_.is_full()) { flush(); }
}

void ProgramSender::flush() {
    if (open_.blocks() == 0 && is_begun_) { return; }
    is_begun_ = true;
    const std::size_t blocks = open_.blocks();
    parts_.push_back({open_.take(), blocks, share_, {}});
}

/// The last part may have no blocks; it marks the end.
void ProgramSender::end(const std::optional<gcode::KeptValues>& after) {
    if (is_ended_) { return; }
    share_ = 1;
    if (after) { open_.add_values(*after); }
    is_begun_ = false;
    flush();
    is_ended_ = true;
}

void ProgramSender::cut(const std::string& why) {
    open_.add_cut(why);
    end();
}

ProgramChunk ProgramSender::chunk(std::uint32_t index, std::vector<std::uint8_t> bytes,
                                  std::optional<double> share) const {
    const bool is_last = is_ended_ && index + 1 == taken_ + parts_.size();
    return {.client = client_,
            .sequence = first_sequence_ + index,
            .program = program_,
            .index = index,
            .count = is_last ? std::optional(index + 1) : std::nullopt,
            .share = share,
            .bytes = std::move(bytes)};
}

std::vector<ProgramChunk> ProgramSender::due(std::chrono::nanoseconds now) {
    std::vector<ProgramChunk> chunks;
    if (refusal_) { return chunks; }
    std::size_t blocks = 0;
    for (std::size_t k = 0; k < std::min(parts_.size(), kPartsInFlight); ++k) {
        Part& part = parts_[k];
        blocks += part.blocks;
        if (blocks > room_) { break; }
        if (part.sent && now - *part.sent < kRepeatAfter) { continue; }
        part.sent = now;
        chunks.push_back(chunk(taken_ + static_cast<std::uint32_t>(k), part.bytes, part.share));
    }
    const bool must_ask = chunks.empty() && taken_ > 0 && !is_done() && now - asked_ >= kAskAfter;
    if (must_ask) { chunks.push_back(chunk(taken_ - 1, {}, share_)); }
    if (must_ask) { chunks.back().count.reset(); }
    if (!chunks.empty()) { asked_ = now; }
    return chunks;
}

bool ProgramSender::lacks_room() const {
    if (is_done() || refusal_) { return false; }
    return parts_.empty() ? room_ <= waiting_ : !parts_.front().sent && parts_.front().blocks > room_;
}

bool ProgramSender::take_answer(const Reply& reply) {
    if (reply.client != client_ || reply.sequence >> 32 != first_sequence_ >> 32) { return false; }
    for (; taken_ < reply.parts && !parts_.empty(); ++taken_) {
        waiting_ -= parts_.front().blocks;
        parts_.pop_front();
    }
    if (reply.parts == taken_) { room_ = reply.free_blocks; }
    lacking_ = reply.parts < taken_ ? lacking_ + 1 : 0;
    if (reply.status == ReplyStatus::Refused) { refusal_ = reply; }
    if (lacking_ >= kMostLacking && !refusal_) { give_up(reply); }
    return true;
}

void ProgramSender::give_up(const Reply& reply) {
    refusal_ = reply;
    refusal_->status = ReplyStatus::Refused;
    refusal_->fault = FaultCode::ProgramCutShort;
    refusal_->text =
        "the coordinator that has taken over lacks a part of the program that was sent before; the machine "
        "runs the part that it has, and rests; then continue: lockstep run FILE --from-line LINE";
}

}  // namespace lockstep
