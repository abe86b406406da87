#include "clients/analysis/course.hpp"

#include <algorithm>
#include <array>

namespace lockstep::analysis {

void Course::Bin::add(Sample sample) {
    if (empty) {
        first = lowest = highest = sample;
        empty = false;
    }
    if (sample.value < lowest.value) { lowest = sample; }
    if (sample.value > highest.value) { highest = sample; }
    last = sample;
}

void Course::Bin::add(const Bin& later) {
    if (later.empty) { return; }
    for (const Sample& sample : {later.first, later.lowest, later.highest, later.last}) { add(sample); }
}

void Course::add(Sample sample) {
    if (bins_.empty()) { origin_ = sample.at; }
    if (sample.at < origin_) { return; }
    while ((sample.at - origin_).value / width_.value >= static_cast<std::int64_t>(kMaxBins)) { widen(); }
    const auto place = static_cast<std::size_t>((sample.at - origin_).value / width_.value);
    if (place >= bins_.size()) { bins_.resize(place + 1); }
    bins_[place].add(sample);
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
