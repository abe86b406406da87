// Delivers an axis's state to the other processes of its machine each slot: by the network, or by shared memory if all
// of them run on one host. Read-only observers always receive it from the network.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "services/wire/bus/endpoints.hpp"
#include "services/wire/shared/state_board.hpp"

namespace lockstep {

class AxisStateWriter {
public:
    /// Writes for the participant's axis.
    explicit AxisStateWriter(Participant& participant);

    /// Never waits. Returns false if the network's buffers are full or DDS is shutting down.
    bool write(const AxisState& state);
    /// The path of the memory file no longer names the open file.
    bool is_memory_replaced() const { return board_ && !board_->is_current(); }

private:
    Writer<AxisState> network_;
    std::optional<StateBoardWriter> board_;
    AxisState shown_;  // the state last written to the network
    std::chrono::nanoseconds shown_at_{0};
};

class AxisStatesReader {
public:
    explicit AxisStatesReader(Participant& participant);

    /// Like Reader::take.
    template <typename Use>
    std::size_t take(Use use) {
        return board_ ? board_->take(use) : network_->take(use);
    }

    const Refusals& refusals() const { return board_ ? board_->refusals() : network_->refusals(); }
    /// The number of matched writers on the network.
    std::uint32_t matched() const { return network_ ? network_->matched() : 0; }
    /// The path of the memory file no longer names the open file.
    bool is_memory_replaced() const { return board_ && !board_->is_current(); }
    /// DDS's delivery of the states; zero if they come by shared memory.
    TopicReception reception() const { return network_ ? network_->reception() : TopicReception{}; }
    /// Names the place from which states are read, for a message about a missing axis: "on the network", or "in FILE".
    std::string place() const;

private:
    std::optional<Reader<AxisState>> network_;
    std::optional<StateBoardReader> board_;
};

}  // namespace lockstep
