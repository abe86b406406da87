// Where a job starts, and how long it is planned to take.
#pragma once

#include <expected>
#include <memory>
#include <vector>

#include "clients/session/session.hpp"
#include "core/program_blocks.hpp"

namespace lockstep {

/// The position of every axis, in mm and to the step. Error: an axis is not received.
std::expected<std::vector<double>, Failure> start_places(Session& session);

/// How long a program takes from there with the session's overrides, s. Error: why it cannot be planned.
std::expected<double, Failure> planned_seconds(const Session& session, const ProgramHead& head,
                                               std::shared_ptr<const ProgramBlocks> blocks,
                                               const std::vector<double>& start_mm);
std::expected<double, Failure> planned_seconds(const Session& session, const Program& program,
                                               const std::vector<double>& start_mm);

}  // namespace lockstep
