#include "services/wire/bus/axis_states.hpp"

#include "services/files/directories.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

constexpr std::chrono::milliseconds kShownEvery{100};

/// Whether the change must be shown at once. A process that acts on a job's end or a fault must not use an older state
/// of the axes.
bool is_news(const AxisState& state, const AxisState& shown) {
    return state.phase != shown.phase || state.at_rest != shown.at_rest || state.homed != shown.homed ||
           state.fault != shown.fault || state.command_done != shown.command_done;
}

/// Returns nullopt if the network is used, or if the board could not be opened. In that case the participant has noted
/// why.
template <typename Board, typename Axis>
std::optional<Board> board_for(Participant& participant, Axis axis) {
    const NetworkConfig& network = participant.network();
    if (!network.one_host) { return std::nullopt; }
    auto board = Board::open(shared_states_file(participant.machine(), network.domain), axis);
    if (board) { return std::move(*board); }
    participant.note_failure(board.error());
    return std::nullopt;
}

}  // namespace

AxisStateWriter::AxisStateWriter(Participant& participant)
    : network_(participant),
      board_(participant.axis() ? board_for<StateBoardWriter>(participant, *participant.axis()) : std::nullopt) {}

bool AxisStateWriter::write(const AxisState& state) {
    if (!board_) { return network_.write(state); }
    board_->write(state);
    const auto now = monotonic_now();
    if (now - shown_at_ < kShownEvery && !is_news(state, shown_)) { return true; }
    shown_at_ = now;
    shown_ = state;
    return network_.write(state);
}

AxisStatesReader::AxisStatesReader(Participant& participant)
    : board_(board_for<StateBoardReader>(participant, participant.axis())) {
    if (!participant.network().one_host) { network_.emplace(participant); }
}

std::string AxisStatesReader::place() const { return board_ ? "in " + board_->path().string() : "on the network"; }

}  // namespace lockstep
