// Steps that are collected one by one, to be read as a StepSpan.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "services/record/reading/steps/step_span.hpp"

namespace lockstep::analysis {

class StepBuffer {
public:
    /// The steps are less than this after the origin.
    static constexpr Ticks kReach{std::int64_t{1} << 30};

    StepBuffer() = default;
    /// Steps of one direction; `directions`: otherwise of each step.
    StepBuffer(Tick origin, std::vector<std::int32_t> ticks, std::int8_t direction,
               std::vector<std::int8_t> directions = {})
        : origin_(origin), ticks_(std::move(ticks)), directions_(std::move(directions)), direction_(direction) {}

    /// Drops all steps. The next ones are after `origin`, or at it.
    void begin(Tick origin) {
        origin_ = origin;
        ticks_.clear();
        directions_.clear();
    }
    void reserve(std::size_t steps) { ticks_.reserve(steps); }
    void add(StepEdge step) {
        if (ticks_.empty()) { direction_ = step.direction; }
        if (step.direction != direction_ && directions_.empty()) { directions_.assign(ticks_.size(), direction_); }
        if (!directions_.empty()) { directions_.push_back(step.direction); }
        ticks_.push_back(static_cast<std::int32_t>((step.tick - origin_).value));
    }
    bool empty() const { return ticks_.empty(); }
    std::size_t size() const { return ticks_.size(); }
    StepSpan steps() const { return {origin_, ticks_, direction_, directions_.empty() ? nullptr : directions_.data()}; }
    /// Moves the ticks out, to use their memory again.
    std::vector<std::int32_t> give_ticks() { return std::move(ticks_); }

private:
    Tick origin_;
    std::vector<std::int32_t> ticks_;
    std::vector<std::int8_t> directions_;  // empty if all have direction_
    std::int8_t direction_ = 0;            // of the first step
};

}  // namespace lockstep::analysis
