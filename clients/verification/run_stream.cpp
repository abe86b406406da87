#include "clients/verification/run_stream.hpp"

#include <utility>

namespace lockstep::verification {

void RunStream::take(Run run) {
    if (incarnation_ != run.incarnation) {
        tell(0);
        incarnation_ = run.incarnation;
        expected_ = 0;
    }
    if (run.sequence < expected_) { return; }  // it came twice
    waiting_.emplace(run.sequence, std::move(run));
    tell(kPatience);
}

void RunStream::tell(std::size_t patience) {
    while (!waiting_.empty()) {
        const std::int64_t first = waiting_.begin()->first;
        if (first != expected_ && waiting_.size() <= patience) { return; }
        if (first != expected_) { on_missing_(expected_, first); }
        expected_ = first + 1;
        on_run_(waiting_.extract(waiting_.begin()).mapped());
    }
}

}  // namespace lockstep::verification
