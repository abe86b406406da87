// A quantity over time in a bounded number of points, peaks included.
//
// Time is cut into equal bins; each keeps its first, lowest, highest and last sample. Where the bins become too many,
// neighbours merge and the bins double in width.
#pragma once

#include <cstddef>
#include <vector>

#include "core/units.hpp"

namespace lockstep::analysis {

/// A quantity at an instant.
struct Sample {
    Tick at;
    double value = 0;
};

class Course {
public:
    static constexpr std::size_t kMaxBins = 4096;
    static constexpr Ticks kFinest{1000};

    /// Samples come in the order of time; one from before the first is left out.
    void add(Sample sample) {
        const bool is_in_latest = sample.at >= latest_from_ && sample.at < latest_end_;
        if (is_in_latest || find_bin(sample.at)) { bins_[latest_].add(sample); }
    }
    std::vector<Sample> samples() const;

private:
    struct Bin {
        bool empty = true;
        Sample first, lowest, highest, last;
        void add(Sample sample) {
            if (empty) {
                first = lowest = highest = sample;
                empty = false;
            }
            if (sample.value < lowest.value) { lowest = sample; }
            if (sample.value > highest.value) { highest = sample; }
            last = sample;
        }
        void add(const Bin& later);
    };

    bool find_bin(Tick at);
    void widen();

    Tick origin_;
    Ticks width_ = kFinest;
    std::vector<Bin> bins_;
    std::size_t latest_ = 0;  // the bin of the latest sample, and its stretch of time
    Tick latest_from_;
    Tick latest_end_;
};

}  // namespace lockstep::analysis
