#include "clients/analysis/measure/late_meter.hpp"

namespace lockstep::analysis {

void LateMeter::on_axis(const std::string& name) {
    axes_.push_back(name);
    skew_.add(name);
    next_.on_axis(name);
}

void LateMeter::on_measured(std::size_t lane, const SharedSteps& steps) {
    next_.on_measured(lane, steps);
    skew_.take(axes_[lane], steps);
}

void LateMeter::on_run(std::size_t lane, const Run& run) {
    next_.on_run(lane, run);
    skew_.take(axes_[lane], run);
}

}  // namespace lockstep::analysis
