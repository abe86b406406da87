#include "tests/property/coordinator/fake_axes.hpp"

#include <algorithm>

namespace lockstep {
namespace {

Position end_of(Position at, std::span<const Piece> pieces) {
    for (const Piece& piece : pieces) { at = at + piece.covered(); }
    return at;
}

Ticks duration_of(std::span<const Piece> pieces) {
    Ticks sum;
    for (const Piece& piece : pieces) { sum = sum + piece.ticks; }
    return sum;
}

}  // namespace

FakeAxes::FakeAxes(std::size_t count, std::uint32_t seed) : random_(seed), axes_(count), orders_(count) {
    for (std::size_t i = 0; i < count; ++i) {
        axes_[i] = {.identity = 100 + i, .axis = static_cast<std::uint32_t>(i), .homed = !one_of(3), .config_hash = 1};
        axes_[i].phase = AxisPhase::Standby;
    }
}

std::span<const AxisState> FakeAxes::states(Slot now, const Term& term) {
    constexpr std::uint64_t kLostOnceIn = 60;
    run_frames(Tick{now * kSlot});
    sent_.clear();
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        AxisState& axis = axes_[i];
        end_order(i, now);
        happen(axis);
        axis.stamp = now;
        axis.tick = Tick{now * kSlot};
        axis.term = std::max(axis.term, term);
        axis.hears_owner = term.number != 0;
        if (!one_of(kLostOnceIn)) { sent_.push_back(axis); }
    }
    std::ranges::shuffle(sent_, random_);
    return sent_;
}

void FakeAxes::take(const Frame& frame) {
    if (frame.epoch != axes_.front().epoch) {
        frames_.clear();
        veto_.reset();
        rests_.reset();
        ran_ = 0;
        for (AxisState& axis : axes_) {
            axis.epoch = frame.epoch;
            axis.held = axis.ran = 0;
            axis.veto.reset();
        }
    }
    if (frame.number != axes_.front().held + 1) { return; }
    Held held{frame.start, frame.ticks, frame.last, {}, {}, {}};
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        axes_[i].held = frame.number;
        held.body_ends.push_back(end_of(frame.axes[i].from, frame.axes[i].body));
        held.tail_ends.push_back(end_of(held.body_ends.back(), frame.axes[i].tail));
        held.tail = std::max(held.tail, duration_of(frame.axes[i].tail));
    }
    frames_[frame.number] = held;
}

void FakeAxes::run_frames(Tick now) {
    while (!frames_.empty() && !rests_) {
        const auto next = frames_.find(ran_ + 1);
        const bool runs = next != frames_.end() && !(veto_ && *veto_ <= ran_ + 1);
        if (runs && next->second.start > now) { return; }
        if (runs) {
            ++ran_;
            for (AxisState& axis : axes_) {
                axis.ran = ran_;
                axis.at_rest = false;
            }
            continue;
        }
        if (ran_ == 0) { return; }
        const Held& last = frames_[ran_];
        if (now < last.start + last.ticks) { return; }
        rests_ = last.start + last.ticks + last.tail;
    }
    if (!rests_ || now < *rests_ || frames_.empty()) { return; }
    rest_at(frames_[ran_].tail_ends);
    frames_.clear();
}

void FakeAxes::rest_at(const std::vector<Position>& places) {
    for (std::size_t i = 0; i < axes_.size(); ++i) {
        axes_[i].position = places[i];
        axes_[i].at_rest = true;
        axes_[i].veto = veto_;
    }
}

void FakeAxes::take(const AxisCommand& order, Slot now) {
    std::optional<Order>& open = orders_[order.axis];
    if (open && open->command.sequence == order.sequence) {
        open->command.until = order.until;
    } else if (order.sequence > axes_[order.axis].command_done) {
        open = Order{order, now + static_cast<Slot>(2 + random_() % 20)};
    }
}

void FakeAxes::end_order(std::size_t i, Slot now) {
    constexpr std::uint64_t kRefusedOnceIn = 60;
    if (!orders_[i] || now < orders_[i]->done) { return; }
    const AxisCommand& order = orders_[i]->command;
    AxisState& axis = axes_[i];
    axis.command_done = order.sequence;
    axis.command_fault = one_of(kRefusedOnceIn) ? FaultCode::HomeSwitchNotFound : FaultCode::None;
    const bool moves = order.kind == AxisCommandKind::MoveOwn || order.kind == AxisCommandKind::Jog;
    if (order.kind == AxisCommandKind::Home) { axis.homed = axis.command_fault == FaultCode::None; }
    if (moves) { axis.position = rest_position(order.target_steps, false); }
    if (order.kind == AxisCommandKind::Reset) {
        axis.fault = FaultCode::None;
        axis.phase = AxisPhase::Standby;
    }
    orders_[i].reset();
}

/// What no coordinator wants, seldom.
void FakeAxes::happen(AxisState& axis) {
    constexpr std::uint64_t kOnceIn = 8000;
    if (one_of(kOnceIn)) {
        ++axis.identity;
        axis.homed = false;
    }
    if (one_of(kOnceIn)) {
        axis.fault = FaultCode::LimitHit;
        axis.phase = AxisPhase::Fault;
    }
    if (one_of(kOnceIn)) { axis.position = axis.position + Displacement::steps(1); }
    if (one_of(kOnceIn) && axis.epoch != 0) {
        axis.veto = ran_ + 2;
        veto_ = axis.veto;
    }
}

}  // namespace lockstep
