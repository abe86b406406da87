// How an axis's state reaches the other processes of its machine each slot: by the network, or, where all of them run
// on one host, by memory that they share. Who looks on hears it on the network in either case.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "services/wire/bus/endpoints.hpp"
#include "services/wire/shared/state_board.hpp"

namespace lockstep {

class StateSaid {
public:
    /// Of the axis for which the participant speaks.
    explicit StateSaid(Participant& participant);

    /// Never waits. False: the network's buffers are full, or DDS is shutting down.
    bool write(const AxisState& state);
    /// The file of the memory is no longer the one that is open.
    bool is_memory_replaced() const { return board_ && !board_->is_current(); }

private:
    Writer<AxisState> network_;
    std::optional<StateBoardWriter> board_;
    AxisState shown_;  // what was last said on the network
    std::chrono::nanoseconds shown_at_{0};
};

class StatesHeard {
public:
    explicit StatesHeard(Participant& participant);

    /// As Reader::take.
    template <typename Use>
    std::size_t take(Use use) {
        return board_ ? board_->take(use) : network_->take(use);
    }

    const Refusals& refusals() const { return board_ ? board_->refusals() : network_->refusals(); }
    /// By how many on the network it is reached.
    std::uint32_t matched() const { return network_ ? network_->matched() : 0; }
    /// The file of the memory is no longer the one that is open.
    bool is_memory_replaced() const { return board_ && !board_->is_current(); }
    /// What DDS delivered of them; where they come by memory: nothing.
    TopicReception reception() const { return network_ ? network_->reception() : TopicReception{}; }
    /// Where who is not heard is waited for.
    std::string place() const;

private:
    std::optional<Reader<AxisState>> network_;
    std::optional<StateBoardReader> board_;
};

}  // namespace lockstep
