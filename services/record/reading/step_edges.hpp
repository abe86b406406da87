// Steps of one axis that several readers keep. Copies share the steps, which do not change.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "core/step/segment.hpp"

namespace lockstep::analysis {

/// The change of the position by some steps. `is_one_way`: they are known not to reverse, which costs no time per step.
std::int64_t change_of(std::span<const StepEdge> steps, bool is_one_way);

/// The number of steps from the first on that are equal, if those of `a` are `later` than those of `b`.
std::size_t equal_steps(std::span<const StepEdge> a, std::span<const StepEdge> b, Ticks later = {});

class StepEdges {
public:
    StepEdges() = default;
    StepEdges(std::vector<StepEdge> steps);  // NOLINT: a vector of steps is one

    const StepEdge* begin() const { return data_; }
    const StepEdge* end() const { return data_ + size_; }
    std::size_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    const StepEdge& front() const { return data_[0]; }
    const StepEdge& back() const { return data_[size_ - 1]; }
    const StepEdge& operator[](std::size_t i) const { return data_[i]; }

    /// The change of the position by all steps.
    std::int64_t change() const { return change_; }
    /// The change by the steps [from, end). Costs no time per step if no step reverses.
    std::int64_t change(std::size_t from, std::size_t end) const {
        return change_of({data_ + from, end - from}, is_one_way());
    }
    bool is_one_way() const { return change_ == std::ssize(*this) || -change_ == std::ssize(*this); }
    /// A hash of all ticks and directions.
    std::size_t content() const { return content_; }

private:
    struct KeptSteps {
        explicit KeptSteps(std::vector<StepEdge> of) : steps(std::move(of)) {}
        KeptSteps(const KeptSteps&) = delete;
        KeptSteps& operator=(const KeptSteps&) = delete;
        ~KeptSteps();
        std::vector<StepEdge> steps;
    };
    std::shared_ptr<const KeptSteps> steps_;
    const StepEdge* data_ = nullptr;
    std::size_t size_ = 0;
    std::int64_t change_ = 0;
    std::size_t content_ = 0;
};

}  // namespace lockstep::analysis
