// Steps of one axis that several readers keep. Copies share the steps, which do not change.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "services/record/reading/steps/step_buffer.hpp"

namespace lockstep::analysis {

class StepEdges : public StepSpan {
public:
    StepEdges() = default;
    explicit StepEdges(StepBuffer steps);
    /// They last less than StepBuffer::kReach.
    StepEdges(const std::vector<StepEdge>& steps);  // NOLINT: a vector of steps is one

    /// The change of the position by all steps.
    std::int64_t change() const { return change_; }
    /// A hash of all ticks and directions.
    std::size_t content() const { return content_; }

private:
    struct KeptSteps {
        explicit KeptSteps(StepBuffer of) : steps(std::move(of)) {}
        KeptSteps(const KeptSteps&) = delete;
        KeptSteps& operator=(const KeptSteps&) = delete;
        ~KeptSteps();
        StepBuffer steps;
    };
    static StepBuffer buffer_of(const std::vector<StepEdge>& steps);
    explicit StepEdges(std::shared_ptr<const KeptSteps> steps);

    std::shared_ptr<const KeptSteps> steps_;
    std::int64_t change_ = 0;
    std::size_t content_ = 0;
};

}  // namespace lockstep::analysis
