#include "services/record/reading/step_edges.hpp"

#include <array>
#include <cstring>
#include <utility>

#include "services/record/reading/content_memory.hpp"
#include "services/record/reading/recycled.hpp"

namespace lockstep::analysis {
namespace {

/// Several hashes in turn, because each waits for its own previous step only. A word has two ticks.
std::size_t content_of(const StepSpan& steps) {
    constexpr std::size_t kTogether = 4;
    std::array<ContentHash, kTogether> hashes;
    std::size_t i = 0;
    for (; i + 2 * kTogether <= steps.size(); i += 2 * kTogether) {
        std::array<std::int64_t, kTogether> words;
        std::memcpy(words.data(), steps.ticks() + i, sizeof words);
        for (std::size_t k = 0; k < kTogether; ++k) { hashes[k].add(words[k]); }
    }
    ContentHash all;
    for (; i < steps.size(); ++i) { all.add(steps.ticks()[i]); }
    for (const ContentHash& hash : hashes) { all.add(static_cast<std::int64_t>(hash.value())); }
    all.add(steps.origin().value).add(std::ssize(steps));
    const std::size_t directions = steps.is_one_way() ? std::min<std::size_t>(1, steps.size()) : steps.size();
    for (std::size_t k = 0; k < directions; ++k) { all.add(steps.direction(k)); }
    return all.value();
}

}  // namespace

StepEdges::KeptSteps::~KeptSteps() { Recycled<std::int32_t>::give(steps.give_ticks()); }

StepEdges::StepEdges(StepBuffer steps) : StepEdges(std::make_shared<const KeptSteps>(std::move(steps))) {}

StepEdges::StepEdges(std::shared_ptr<const KeptSteps> steps)
    : StepSpan(steps->steps.steps()),
      steps_(std::move(steps)),
      change_(StepSpan::change()),
      content_(content_of(*this)) {}

StepEdges::StepEdges(const std::vector<StepEdge>& steps) : StepEdges(buffer_of(steps)) {}

StepBuffer StepEdges::buffer_of(const std::vector<StepEdge>& steps) {
    StepBuffer buffer;
    if (!steps.empty()) { buffer.begin(steps.front().tick); }
    for (const StepEdge& step : steps) { buffer.add(step); }
    return buffer;
}

}  // namespace lockstep::analysis
