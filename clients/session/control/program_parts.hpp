// Programs that are sent while they are read. The lines behind a probing move depend on its touch, so each part of the
// program ends with such a move, and is a job of its own.
#pragma once

#include <cstdint>
#include <expected>

#include "clients/session/program_stream.hpp"
#include "clients/session/session.hpp"
#include "core/gcode/gcode.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {

/// Begins to send the present part. Returns its id for a command as soon as the coordinator has its first blocks, or
/// all of it if the machine plans programs as a whole. Fails like stream_program(), and if such a part has too many
/// blocks.
std::expected<std::uint64_t, Failure> send_part(Session& session, ProgramStream& stream,
                                                const StopSignal* stop = nullptr);
/// Sends until the coordinator has all of the part and no longer needs this process.
std::expected<void, Failure> send_rest(Session& session, const StopSignal* stop = nullptr);

/// Reads the next part, behind the touch of the job that ran the present one. Fails if a line has an error, or if the
/// values that the present part changes are not kept.
std::expected<void, Failure> read_next_part(Session& session, ProgramStream& stream, const ProbeTouch& touch);
/// Waits until the offsets and tools that the present part changes are on the coordinator's disk.
std::expected<void, Failure> await_kept(Session& session, const ProgramStream& stream);

}  // namespace lockstep
