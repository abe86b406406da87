// Axes for a coordinator alone: they report what it expects of them, nearly always. Slots of 1,000 ticks.
#pragma once

#include <algorithm>
#include <map>
#include <random>
#include <span>
#include <vector>

#include "core/protocol/messages.hpp"

namespace lockstep {

class FakeAxes {
public:
    static constexpr std::int64_t kSlot = 1000;

    FakeAxes(std::size_t count, std::uint32_t seed);

    /// The states that the coordinator receives in this slot, in any order.
    std::span<const AxisState> states(Slot now, const Term& term);
    void take(const Frame& frame);
    void take(const AxisCommand& order, Slot now);
    std::int64_t count(std::size_t axis) const { return axes_[axis].position.count(); }
    bool are_homed() const { return std::ranges::all_of(axes_, &AxisState::homed); }
    void take_veto(std::optional<FrameNumber> veto) { veto_ = veto; }

private:
    struct Held {
        Tick start;
        Ticks ticks;
        bool last = false;
        std::vector<Position> body_ends;
        std::vector<Position> tail_ends;
        Ticks tail;
    };
    struct Order {
        AxisCommand command;
        Slot done = 0;
    };

    bool one_of(std::uint64_t n) { return random_() % n == 0; }
    void run_frames(Tick now);
    void rest_at(const std::vector<Position>& places);
    void end_order(std::size_t axis, Slot now);
    void happen(AxisState& axis);

    std::mt19937_64 random_;
    std::vector<AxisState> axes_;
    std::vector<std::optional<Order>> orders_;
    std::vector<AxisState> sent_;
    std::map<FrameNumber, Held> frames_;
    std::optional<FrameNumber> veto_;
    std::optional<Tick> rests_;
    FrameNumber ran_ = 0;
};

}  // namespace lockstep
