// The steps of a move by one of the published methods, one after the other: a train of any length costs nothing ahead.
#pragma once

#include <expected>
#include <string>
#include <utility>
#include <variant>

#include "core/machine.hpp"
#include "core/methods/carrica.hpp"
#include "core/methods/lai/lai.hpp"
#include "core/methods/lam.hpp"
#include "core/methods/spielauer.hpp"

namespace lockstep::stepgen {

class StepSource {
public:
    /// The nearest that the method makes of the move as its paper has it, so that it keeps limits that suit it
    /// (suits.hpp): spielauer, lai and lam start slowly whatever the start speed, lai changes its speed by one pulse
    /// per period, carrica's least speed lies two steps' acceleration below the start speed. Error: it makes nothing of
    /// it, or the method is Ranade's, whose moves are pieces and not steps (core/motion/profile.hpp).
    static std::expected<StepSource, std::string> of(StepMethod method, const StepMove& move);

    /// When the next step falls, in s from the start of the move. Call it for each of the move's steps once.
    double next_s() {
        return std::visit([](auto& steps) { return steps.next_s(); }, steps_);
    }

private:
    using Steps = std::variant<SpielauerSteps, LaiSteps, LamSteps, CarricaSteps>;
    explicit StepSource(Steps steps) : steps_(std::move(steps)) {}

    Steps steps_;
};

}  // namespace lockstep::stepgen
