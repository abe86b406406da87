#include "services/record/reading/step_edges.hpp"

#include <array>

#include "services/record/reading/content_memory.hpp"

namespace lockstep::analysis {

/// Several hashes in turn, because each waits for its own previous step only.
StepEdges::StepEdges(std::vector<StepEdge> steps)
    : steps_(std::make_shared<const std::vector<StepEdge>>(std::move(steps))),
      data_(steps_->data()),
      size_(steps_->size()) {
    constexpr std::size_t kTogether = 4;
    std::array<ContentHash, kTogether> hashes;
    const auto add = [&](std::size_t i, ContentHash& hash) {
        change_ += data_[i].direction;
        hash.add(2 * data_[i].tick.value + (data_[i].direction > 0 ? 1 : 0));
    };
    std::size_t i = 0;
    for (; i + kTogether <= size_; i += kTogether) {
        for (std::size_t k = 0; k < kTogether; ++k) { add(i + k, hashes[k]); }
    }
    for (; i < size_; ++i) { add(i, hashes[0]); }
    ContentHash all;
    for (const ContentHash& hash : hashes) { all.add(static_cast<std::int64_t>(hash.value())); }
    content_ = all.value();
}

std::int64_t change_of(std::span<const StepEdge> steps, bool is_one_way) {
    if (steps.empty()) { return 0; }
    if (is_one_way) { return std::ssize(steps) * steps.front().direction; }
    std::int64_t change = 0;
    for (const StepEdge& step : steps) { change += step.direction; }
    return change;
}

}  // namespace lockstep::analysis
