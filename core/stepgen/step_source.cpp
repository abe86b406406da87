#include "core/stepgen/step_source.hpp"

namespace lockstep::stepgen {

std::expected<StepSource, std::string> StepSource::of(StepMethod method, const StepMove& move) {
    const auto source = [](auto steps) -> std::expected<StepSource, std::string> {
        if (!steps) { return std::unexpected(std::move(steps.error())); }
        return StepSource(std::move(*steps));
    };
    switch (method) {
        case StepMethod::Ranade: break;
        case StepMethod::Spielauer: return source(SpielauerSteps::of(move, Fit::Nearest));
        case StepMethod::Lai: return source(LaiSteps::of(move, Fit::Nearest));
        case StepMethod::Lam: return source(LamSteps::of(move, Fit::Nearest));
        case StepMethod::Carrica: return source(CarricaSteps::of(move, Fit::Nearest));
    }
    return std::unexpected(std::string("moves of this method are pieces, not single steps"));
}

}  // namespace lockstep::stepgen
