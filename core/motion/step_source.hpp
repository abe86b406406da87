// The steps of a move, one after the other. The caller chooses the method that makes them by its BeginSteps.
#pragma once

#include <expected>
#include <memory>
#include <string_view>

#include "core/enumeration.hpp"
#include "core/machine.hpp"
#include "core/motion/step_error.hpp"
#include "core/motion/step_move.hpp"

namespace lockstep {

/// The name of a method, such as "ranade".
constexpr std::string_view name_of(StepMethod method) {
    return pick_name({"ranade", "spielauer", "lai", "lam", "carrica"}, method);
}

class StepSource {
public:
    virtual ~StepSource() = default;
    /// The time of the next step, in s from the start of the move. Call it once for each step of the move.
    virtual double next_s() = 0;
};

/// Begins a move by a method.
using BeginSteps = std::expected<std::unique_ptr<StepSource>, StepError> (*)(StepMethod, const StepMove&);

}  // namespace lockstep
