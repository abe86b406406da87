// How an axis's state reaches the other processes of its machine each slot: by the network, or, if all of them run
// on one host, by shared memory. Read-only observers receive it from the network in either case.
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
    /// Of the axis for which the participant writes.
    explicit AxisStateWriter(Participant& participant);

    /// Never waits. False: the network's buffers are full, or DDS is shutting down.
    bool write(const AxisState& state);
    /// The path of the memory file no longer names the open file.
    bool is_memory_replaced() const { return board_ && !board_->is_current(); }

private:
    Writer<AxisState> network_;
    std::optional<StateBoardWriter> board_;
    AxisState shown_;  // what was last written to the network
    std::chrono::nanoseconds shown_at_{0};
};

class AxisStatesReader {
public:
    explicit AxisStatesReader(Participant& participant);

    /// As Reader::take.
    template <typename Use>
    std::size_t take(Use use) {
        return board_ ? board_->take(use) : network_->take(use);
    }

    const Refusals& refusals() const { return board_ ? board_->refusals() : network_->refusals(); }
    /// How many writers on the network it is matched with.
    std::uint32_t matched() const { return network_ ? network_->matched() : 0; }
    /// The path of the memory file no longer names the open file.
    bool is_memory_replaced() const { return board_ && !board_->is_current(); }
    /// DDS's delivery of the states; if they come by memory: nothing.
    TopicReception reception() const { return network_ ? network_->reception() : TopicReception{}; }
    /// Where the states of a missing axis are expected.
    std::string place() const;

private:
    std::optional<Reader<AxisState>> network_;
    std::optional<StateBoardReader> board_;
};

}  // namespace lockstep
