#include "clients/analysis/speed_course.hpp"

#include <algorithm>
#include <array>

namespace lockstep::analysis {

void SpeedCourse::Bin::add(SpeedSample sample) {
    if (empty) {
        first = lowest = highest = sample;
        empty = false;
    }
    if (sample.steps_per_tick < lowest.steps_per_tick) { lowest = sample; }
    if (sample.steps_per_tick > highest.steps_per_tick) { highest = sample; }
    last = sample;
}

void SpeedCourse::Bin::add(const Bin& later) {
    if (later.empty) { return; }
    for (const SpeedSample& sample : {later.first, later.lowest, later.highest, later.last}) { add(sample); }
}

void SpeedCourse::add(SpeedSample sample) {
    if (bins_.empty()) { origin_ = sample.at; }
    if (sample.at < origin_) { return; }
    while ((sample.at - origin_).value / width_.value >= static_cast<std::int64_t>(kMaxBins)) { widen(); }
    const auto place = static_cast<std::size_t>((sample.at - origin_).value / width_.value);
    if (place >= bins_.size()) { bins_.resize(place + 1); }
    bins_[place].add(sample);
}

void SpeedCourse::widen() {
    std::vector<Bin> wider((bins_.size() + 1) / 2);
    for (std::size_t i = 0; i < bins_.size(); ++i) { wider[i / 2].add(bins_[i]); }
    bins_ = std::move(wider);
    width_ = width_ * 2;
}

std::vector<SpeedSample> SpeedCourse::samples() const {
    std::vector<SpeedSample> all;
    for (const Bin& bin : bins_) {
        if (bin.empty) { continue; }
        std::array<SpeedSample, 4> four = {bin.first, bin.lowest, bin.highest, bin.last};
        std::ranges::sort(four, {}, &SpeedSample::at);
        for (const SpeedSample& sample : four) {
            if (all.empty() || all.back().at < sample.at) { all.push_back(sample); }
        }
    }
    return all;
}

}  // namespace lockstep::analysis
