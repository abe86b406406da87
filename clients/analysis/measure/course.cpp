#include "clients/analysis/measure/course.hpp"

#include <algorithm>
#include <array>

namespace lockstep::analysis {

void Course::Bin::add(const Bin& later) {
    if (later.empty) { return; }
    for (const Sample& sample : {later.first, later.lowest, later.highest, later.last}) { add(sample); }
}

/// Returns false if `at` is before the first sample, where there is no bin.
bool Course::find_bin(Tick at) {
    if (bins_.empty()) { origin_ = at; }
    if (at < origin_) { return false; }
    while ((at - origin_).value / width_.value >= static_cast<std::int64_t>(kMaxBins)) { widen(); }
    const std::int64_t place = (at - origin_).value / width_.value;
    latest_ = static_cast<std::size_t>(place);
    latest_from_ = origin_ + width_ * place;
    latest_end_ = latest_from_ + width_;
    if (latest_ >= bins_.size()) { bins_.resize(latest_ + 1); }
    return true;
}

void Course::widen() {
    std::vector<Bin> wider((bins_.size() + 1) / 2);
    for (std::size_t i = 0; i < bins_.size(); ++i) { wider[i / 2].add(bins_[i]); }
    bins_ = std::move(wider);
    width_ = width_ * 2;
}

std::vector<Sample> Course::samples() const {
    std::vector<Sample> all;
    for (const Bin& bin : bins_) {
        if (bin.empty) { continue; }
        std::array<Sample, 4> four = {bin.first, bin.lowest, bin.highest, bin.last};
        std::ranges::sort(four, {}, &Sample::at);
        for (const Sample& sample : four) {
            if (all.empty() || all.back().at < sample.at) { all.push_back(sample); }
        }
    }
    return all;
}

}  // namespace lockstep::analysis
