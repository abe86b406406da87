// A quantity over time in a bounded number of points, including its peaks.
//
// Time is divided into equal bins, and each bin keeps its first, lowest, highest and last sample. If there are too many
// bins, neighbours are merged and the bins double in width.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <ranges>
#include <vector>

#include "core/units.hpp"

namespace lockstep::analysis {

/// A quantity at an instant.
struct Sample {
    Tick at;
    double value = 0;
};

/// Some consecutive samples and their range.
struct SampleBlock {
    static constexpr std::size_t kSize = 16;

    Tick origin;
    std::array<std::int32_t, kSize> at;  // since the origin
    std::array<double, kSize> value;
    double lowest = 0;
    double highest = 0;

    Sample operator[](std::size_t i) const { return {origin + Ticks{at[i]}, value[i]}; }
};

class Course {
public:
    static constexpr std::size_t kMaxBins = 4096;
    static constexpr Ticks kFinest{1000};

    /// Samples come in the order of time. Leaves out a sample that is earlier than the first.
    void add(Sample sample) {
        if (is_in_latest(sample.at) || find_bin(sample.at)) { bins_[latest_].add(sample); }
    }
    /// Adds samples in order; costs less if they are in one bin and within its values.
    void add_block(const SampleBlock& block) {
        const bool is_within = is_in_latest(block[0].at) && is_in_latest(block[SampleBlock::kSize - 1].at) &&
                               bins_[latest_].covers(block.lowest, block.highest);
        if (is_within) {
            bins_[latest_].last = block[SampleBlock::kSize - 1];
            return;
        }
        for (std::size_t i = 0; i < SampleBlock::kSize; ++i) { add(block[i]); }
    }
    /// Adds samples of one value at the times at(0) ... at(count - 1), in order. Only the first and the last in a bin
    /// are needed.
    template <typename At>
    void add_equal(double value, std::size_t count, At&& at) {
        for (std::size_t i = 0; i < count;) {
            add({at(i), value});
            const auto is_in_same = [&](std::size_t k) { return is_in_latest(at(i)) && is_in_latest(at(k)); };
            const std::size_t end = *std::ranges::partition_point(std::views::iota(i + 1, count), is_in_same);
            if (end > i + 1) { add({at(end - 1), value}); }
            i = end;
        }
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
        bool covers(double low, double high) const { return !empty && lowest.value <= low && high <= highest.value; }
    };
    bool is_in_latest(Tick at) const { return at >= latest_from_ && at < latest_end_; }
    bool find_bin(Tick at);
    void widen();

    Tick origin_;
    Ticks width_ = kFinest;
    std::vector<Bin> bins_;
    std::size_t latest_ = 0;  // the bin of the latest sample, and its range of time
    Tick latest_from_;
    Tick latest_end_;
};

}  // namespace lockstep::analysis
