#include "clients/verification/steps/compared_run.hpp"

#include <utility>

namespace lockstep::verification {

void ComparedRun::begin(Run run, bool is_behind_gap) {
    maker_.emplace(std::move(run));
    if (is_behind_gap && follower_ != nullptr) { follower_->on_gap(); }
}

void ComparedRun::accept() {
    if (follower_ != nullptr) { follower_->on_run(run()); }
}

void ComparedRun::end() {
    before_ = run();
    maker_.reset();
    if (follower_ != nullptr) { follower_->on_run_over(); }
}

void ComparedRun::finish() {
    if (follower_ != nullptr) { follower_->on_end(); }
}

bool ComparedRun::is_cut_here(const SeenStep* seen) {
    if (!run().cut || maker_->count() != run().stop_count) { return false; }
    return seen == nullptr || seen->edge != *maker_->next();
}

void ComparedRun::pass_step(bool is_recorded) {
    if (follower_ != nullptr) { follower_->on_step(*maker_->next(), maker_->commanded(), is_recorded); }
    maker_->pass();
}

std::int64_t ComparedRun::pass_unrecorded() {
    std::int64_t steps = 0;
    for (; maker_->next() != nullptr && !is_cut_here(nullptr); pass_step(false)) { ++steps; }
    return steps;
}

}  // namespace lockstep::verification
