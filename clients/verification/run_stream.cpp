#include "clients/verification/run_stream.hpp"

#include <utility>

namespace lockstep::verification {

void RunStream::expect_from(std::int64_t incarnation, std::int64_t number) {
    if (incarnation_ != incarnation) { marked_.try_emplace(incarnation, number); }
}

void RunStream::take(Run run) {
    if (incarnation_ != run.incarnation) {
        deliver(0);
        const bool is_first = !incarnation_;
        incarnation_ = run.incarnation;
        const auto marked = marked_.find(run.incarnation);
        expected_ = marked != marked_.end() ? std::optional(marked->second)
                    : is_first              ? std::nullopt
                                            : std::optional<std::int64_t>(0);
    }
    if (expected_ && run.sequence < *expected_) { return; }  // a repeat
    waiting_.emplace(run.sequence, std::move(run));
    deliver(kPatience);
}

void RunStream::deliver(std::size_t patience) {
    while (!waiting_.empty()) {
        const std::int64_t first = waiting_.begin()->first;
        const bool is_next = !expected_ || first == *expected_;
        if (!is_next && waiting_.size() <= patience) { return; }
        if (!is_next) { on_missing_(*expected_, first); }
        expected_ = first + 1;
        on_run_(waiting_.extract(waiting_.begin()).mapped());
    }
}

}  // namespace lockstep::verification
