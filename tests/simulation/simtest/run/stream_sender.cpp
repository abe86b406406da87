#include "tests/simulation/simtest/run/stream_sender.hpp"

#include <utility>

namespace lockstep::simtest {

StreamSender::StreamSender(VirtualMachine& vm, std::uint64_t id, Program program, const std::vector<SentPart>& parts)
    : vm_(vm), id_(id), program_(std::move(program)), parts_(parts), moved_on_(vm.now()), sent_(vm.now()) {}

Ticks StreamSender::ticks(double seconds) const {
    return {static_cast<std::int64_t>(seconds * vm_.machine().ticks_per_second())};
}

ProgramPart StreamSender::part(std::size_t index) const {
    std::size_t first = 0;
    for (std::size_t k = 0; k < index; ++k) { first += parts_[k].blocks; }
    const auto from = program_.blocks.begin() + static_cast<std::ptrdiff_t>(first);
    ProgramPart part{.index = static_cast<std::uint32_t>(index), .is_last = index + 1 == parts_.size()};
    if (index == 0) { part.head = program_.head(); }
    part.blocks.assign(from, from + static_cast<std::ptrdiff_t>(parts_[index].blocks));
    return part;
}

void StreamSender::send(ProgramPart part) {
    part.program = id_;
    awaited_ = vm_.send(std::move(part));
    sent_ = vm_.now();
}

/// A new owner may lack parts that the previous owner had taken.
void StreamSender::take(const Reply& reply) {
    if (reply.status == ReplyStatus::Refused) { refusal_ = reply; }
    if (reply.parts != taken_) { moved_on_ = vm_.now(); }
    taken_ = reply.parts;
    awaited_.reset();
}

void StreamSender::tend() {
    if (is_done()) { return; }
    if (awaited_) {
        if (const Reply* reply = vm_.reply_to(*awaited_)) { take(*reply); }
    }
    if (is_done() || (awaited_ && vm_.now() - sent_ < ticks(kRepeatAfter_s))) { return; }
    if (vm_.now() - moved_on_ >= ticks(parts_[taken_].after_s)) {
        send(part(taken_));
    } else if (taken_ > 0 && vm_.now() - sent_ >= ticks(kAskAfter_s)) {
        send({.index = taken_, .is_question = true});
    }
}

}  // namespace lockstep::simtest
