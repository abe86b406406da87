// Where a job starts, and how long it is planned to take.
#pragma once

#include <expected>
#include <memory>
#include <vector>

#include "clients/session/session.hpp"
#include "core/program_blocks.hpp"

namespace lockstep {

/// Returns the position of every axis, in mm and exact to the step. Fails if an axis is not received.
std::expected<std::vector<double>, Failure> start_places(Session& session);

/// Returns how long a program takes from `start_mm` with the session's overrides, in s. The error says why it cannot be
/// planned.
std::expected<double, Failure> planned_seconds(const Session& session, const ProgramHead& head,
                                               std::shared_ptr<const ProgramBlocks> blocks,
                                               const std::vector<double>& start_mm);
std::expected<double, Failure> planned_seconds(const Session& session, const Program& program,
                                               const std::vector<double>& start_mm);

}  // namespace lockstep
