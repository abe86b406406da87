#include "services/record/reading/step_edges.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>

#include "services/record/reading/content_memory.hpp"
#include "services/record/reading/recycled.hpp"

namespace lockstep::analysis {

StepEdges::KeptSteps::~KeptSteps() { Recycled<StepEdge>::give(std::move(steps)); }

/// Several hashes in turn, because each waits for its own previous step only.
StepEdges::StepEdges(std::vector<StepEdge> steps)
    : steps_(std::make_shared<const KeptSteps>(std::move(steps))),
      data_(steps_->steps.data()),
      size_(steps_->steps.size()) {
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

/// Compares many steps without a branch for each, a step in one vector: its tick, and a word of which the lowest byte
/// is its direction.
std::size_t equal_steps(std::span<const StepEdge> a, std::span<const StepEdge> b, Ticks later) {
    constexpr std::size_t kTogether = 16;
    using Words [[gnu::vector_size(sizeof(StepEdge))]] = std::int64_t;
    static_assert(sizeof(StepEdge) == 2 * sizeof(std::int64_t) &&
                  offsetof(StepEdge, direction) == sizeof(std::int64_t));
    static_assert(std::endian::native == std::endian::little);
    const Words expected{later.value, 0};
    const Words compared{-1, 0xff};
    const std::size_t most = std::min(a.size(), b.size());
    std::size_t equal = 0;
    for (; equal + kTogether <= most; equal += kTogether) {
        Words differences{};
        for (std::size_t i = equal; i < equal + kTogether; ++i) {
            Words of_a;
            Words of_b;
            std::memcpy(&of_a, &a[i], sizeof of_a);
            std::memcpy(&of_b, &b[i], sizeof of_b);
            differences |= ((of_a - of_b) ^ expected) & compared;
        }
        if ((differences[0] | differences[1]) != 0) { break; }
    }
    const auto difference = [&](std::size_t i) {
        return ((a[i].tick - b[i].tick).value ^ later.value) | (a[i].direction ^ b[i].direction);
    };
    while (equal < most && difference(equal) == 0) { ++equal; }
    return equal;
}

}  // namespace lockstep::analysis
