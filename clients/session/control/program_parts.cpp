#include "clients/session/control/program_parts.hpp"

#include <fmt/format.h>

#include "clients/session/waits.hpp"
#include "core/coordinator/path/coordination.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;

/// `before_it_runs`: fails if there is no room for all of it.
std::expected<void, Failure> send_all(Session& session, const StopSignal* stop, bool before_it_runs) {
    while (!session.upload().sender()->is_done() && !session.upload().sender()->refusal()) {
        if (stop != nullptr && stop->requested()) {
            return std::unexpected(failed("interrupted; the machine runs the part that was sent"));
        }
        if (session.is_silent()) { return std::unexpected(silence(session)); }
        if (before_it_runs && session.upload().sender()->lacks_room()) {
            return std::unexpected(bad_input(
                fmt::format("with coordination: LAI a program is planned as a whole, so it has at most {} blocks; "
                            "split it in two, or choose another coordination",
                            kMaxProgramBlocks)));
        }
        session.receive(100ms);
    }
    return {};
}

}  // namespace

std::expected<std::uint64_t, Failure> send_part(Session& session, ProgramStream& stream, const StopSignal* stop) {
    const auto feed = [&stream](ProgramSender& sender) { stream.feed(sender, monotonic_now()); };
    const auto program = stream_program(session, stream.head(), stream.values(), feed, stop);
    if (!program || !coordination_of(session.config()).plans_whole) { return program; }
    const auto sent = send_all(session, stop, true);
    return sent ? program : std::unexpected(sent.error());
}

std::expected<void, Failure> send_rest(Session& session, const StopSignal* stop) {
    return send_all(session, stop, false);
}

std::expected<void, Failure> read_next_part(Session& session, ProgramStream& stream, const ProbeTouch& touch) {
    if (auto kept = await_kept(session, stream); !kept) { return kept; }
    const auto values = await_values(session);
    if (!values) { return std::unexpected(values.error()); }
    const auto read = stream.touched(touch, values->revision);
    return read ? std::expected<void, Failure>{} : std::unexpected(bad_file(stream.head().name, read.error()));
}

std::expected<void, Failure> await_kept(Session& session, const ProgramStream& stream) {
    if (!stream.changes_values()) { return {}; }
    return await_kept(session, stream.values().revision + 1);
}

}  // namespace lockstep
