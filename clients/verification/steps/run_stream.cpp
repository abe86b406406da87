#include "clients/verification/steps/run_stream.hpp"

#include <algorithm>
#include <utility>

namespace lockstep::verification {
namespace {

std::size_t content_of(const Run& run) {
    analysis::ContentHash hash;
    hash.add(run.epoch).add(run.frame).add(run.tail).add(run.start.value).add(run.from.count()).add(run.cut);
    hash.add(run.stop_count).add(run.zero_count).add(run.ahead.value).add(run.clock_error.value);
    for (const Piece& piece : run.pieces) {
        hash.add(piece.ticks.value).add(piece.velocity.raw).add(piece.acceleration.raw);
    }
    for (const Ticks ticks : run.commanded_ticks) { hash.add(ticks.value); }
    return hash.value();
}

}  // namespace

/// A repeat must have the content of the first one, as far as that is remembered.
bool RunStream::is_repeat(const Run& run) {
    const std::size_t content = content_of(run);
    const auto before = contents_.find({run.incarnation, run.sequence});
    if (before && *before != content) { on_other_(run); }
    if (!before) { contents_.add({run.incarnation, run.sequence}, content); }
    return before.has_value();
}

void RunStream::expect_from(std::int64_t incarnation, std::int64_t number) {
    if (incarnation_ != incarnation) { marked_.try_emplace(incarnation, number); }
}

void RunStream::take(Run run) {
    if (is_repeat(run)) { return; }
    if (incarnation_ != run.incarnation) {
        deliver(0);
        const auto marked = marked_.find(run.incarnation);
        accepts_any_ = !incarnation_ && marked == marked_.end();
        incarnation_ = run.incarnation;
        expected_ = marked != marked_.end() ? marked->second : 0;
    }
    if (run.sequence < expected_) { return; }  // it was given up as missing
    waiting_.emplace(run.sequence, std::move(run));
    deliver(kPatience);
}

void RunStream::deliver(std::size_t patience) {
    while (!waiting_.empty()) {
        const std::int64_t first = waiting_.begin()->first;
        const bool begins_late = accepts_any_ && first > kShuffled;
        const bool is_next = first == expected_ || begins_late;
        if (!is_next && waiting_.size() <= (accepts_any_ ? std::min<std::size_t>(patience, kShuffled) : patience)) {
            return;
        }
        if (!is_next && !accepts_any_) { on_missing_(expected_, first); }
        accepts_any_ = false;
        expected_ = first + 1;
        on_run_(waiting_.extract(waiting_.begin()).mapped());
    }
}

}  // namespace lockstep::verification
