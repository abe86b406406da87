// One message of steps as analysis takes it.
#pragma once

#include <expected>
#include <lockstep/step_batch_t.hpp>
#include <string>

#include "clients/analysis/step_stream.hpp"

namespace lockstep::analysis {

/// The error says what cannot be: ticks that do not rise, directions other than +1 and -1.
std::expected<StepBatch, std::string> to_batch(const step_batch_t& message);

}  // namespace lockstep::analysis
