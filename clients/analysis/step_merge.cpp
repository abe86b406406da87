#include "clients/analysis/step_merge.hpp"

namespace lockstep::analysis {

std::size_t StepMerge::add_lane() {
    lanes_.emplace_back();
    next_.push_back(kNever);
    return lanes_.size() - 1;
}

void StepMerge::take(std::size_t lane, std::span<const MeasuredStep> steps) {
    if (steps.empty()) { return; }
    lanes_[lane].steps.insert(lanes_[lane].steps.end(), steps.begin(), steps.end());
    newest_ = std::max(newest_, steps.back().tick);
}

void StepMerge::forget_told() {
    for (auto& [steps, told] : lanes_) {
        if (told * 2 < steps.size()) { continue; }
        steps.erase(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(told));
        told = 0;
    }
}

}  // namespace lockstep::analysis
