#include "clients/analysis/step_merge.hpp"

#include <algorithm>

namespace lockstep::analysis {

std::size_t StepMerge::add_lane() {
    lanes_.emplace_back();
    return lanes_.size() - 1;
}

void StepMerge::take(std::size_t lane, const MeasuredStep& step) {
    lanes_[lane].steps.push_back(step);
    newest_ = std::max(newest_, step.tick);
}

/// The lane whose next step is first is told up to the next step of any other.
void StepMerge::tell_before(Tick end) {
    for (;;) {
        Lane* first = nullptr;
        Tick until = end;
        for (Lane& lane : lanes_) {
            if (lane.empty() || lane.next() >= end) { continue; }
            if (first == nullptr || lane.next() < first->next()) {
                if (first != nullptr) { until = first->next(); }
                first = &lane;
            } else {
                until = std::min(until, lane.next());
            }
        }
        if (first == nullptr) { break; }
        const auto number = static_cast<std::size_t>(first - lanes_.data());
        do { listener_.on_step(number, first->steps[first->told++]); } while (!first->empty() && first->next() < until);
    }
    for (Lane& lane : lanes_) {
        if (lane.told * 2 < lane.steps.size()) { continue; }
        lane.steps.erase(lane.steps.begin(), lane.steps.begin() + static_cast<std::ptrdiff_t>(lane.told));
        lane.told = 0;
    }
}

}  // namespace lockstep::analysis
