#include "clients/simulation/program_feed.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "core/if_positive.hpp"

namespace lockstep {
namespace {

constexpr double kAskAfter_s = 0.1;  // well within ProgramStore::kSenderSilence_s

}  // namespace

std::string place_and_text(const std::string& file, const Diagnostic& error) {
    return fmt::format("{}:{}:{}: {}", file, error.line, error.column, error.message);
}

ProgramFeed::ProgramFeed(VirtualMachine& vm, std::uint64_t program, ProgramText& text,
                         std::function<void(std::size_t blocks)> make_room)
    : vm_(vm),
      program_(program),
      text_(text),
      make_room_(std::move(make_room)),
      ask_after_{std::llround(kAskAfter_s * vm.machine().ticks_per_second())} {}

void ProgramFeed::tend() {
    if (unanswered_) {
        const Reply* const reply = vm_.reply_to(*unanswered_);
        if (reply == nullptr) { return; }
        take_answer(*reply);
    }
    if (refusal_ || (is_over_ && !part_)) { return; }
    if (!part_) { part_ = next_part(); }
    if (has_room()) { return send(*part_); }
    if (vm_.now() - sent_ < ask_after_) { return; }
    send({.program = program_, .index = index_ - 1, .is_question = true});
}

/// The last part may have no blocks; it marks the end.
ProgramPart ProgramFeed::next_part() {
    ProgramPart part{.program = program_, .index = index_};
    if (index_ == 0) { part.head = text_.head(); }
    part.blocks.reserve(kBlocks);
    while (part.blocks.size() < kBlocks && !text_.ends_before(next_)) { part.blocks.push_back(*text_.block(next_++)); }
    part.share = if_positive(text_.share_read());
    if (part.blocks.size() == kBlocks) { return part; }
    part.is_last = is_over_ = true;
    if (const Diagnostics& errors = text_.errors(); !errors.empty()) {
        cut_ = place_and_text(text_.head().name, errors.front());
        part.cut = cut_;
    }
    return part;
}

void ProgramFeed::send(ProgramPart part) {
    is_question_ = part.is_question;
    sent_ = vm_.now();
    unanswered_ = vm_.send(std::move(part));
}

/// If the planner lacks blocks while there is no room, it looks further ahead than the coordinator keeps blocks. The
/// machine would rest forever, so the coordinator is told to keep more.
void ProgramFeed::take_answer(const Reply& reply) {
    if (reply.parts > index_) {
        index_ = reply.parts;
        part_.reset();
    }
    room_ = reply.free_blocks;
    if (reply.status == ReplyStatus::Refused) { refusal_ = reply; }
    vm_.forget_reply(*std::exchange(unanswered_, std::nullopt));
    if (is_question_ && part_ && !has_room() && vm_.state()->lacks_blocks) { make_room_(kBlocks); }
}

std::string ProgramFeed::trouble() const {
    if (refusal_) { return text_.head().name + ": " + refusal_->text; }
    return cut_.empty() ? "" : cut_ + "\nthe file has changed since it was checked; the lines before this one were run";
}

}  // namespace lockstep
