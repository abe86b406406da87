// The add-only step engine, tick by tick in blocks: equal to core/step/tick_engine.hpp, for processors of 32 bits.
#pragma once

#include <cstdint>

#include "sim_fpga/firmware/device/step_block.hpp"

namespace lockstep::firmware {

/// Motion with constant acceleration. Velocity and acceleration are two's complement, as in the register map.
struct Piece {
    std::int64_t ticks = 0;
    std::uint64_t velocity = 0;
    std::uint64_t acceleration = 0;
};

/// Whether it lasts 1 to kLongestPiece ticks and its velocity never leaves 64 bits.
bool is_executable(const Piece& piece);

/// A place: the count of whole steps, and the low 64 bits of position + 1/2 step.
struct Place {
    std::int64_t count = 0;
    std::uint64_t phase = 0;
    constexpr bool operator==(const Place&) const = default;
};

/// At rest on a whole step, about to move forward. Backward motion starts one unit lower.
inline constexpr std::uint64_t kForwardPhase = std::uint64_t{1} << 63;
inline constexpr std::uint64_t kBackwardPhase = kForwardPhase - 1;

/// The engine's registers, in the order in which the assembler loads them.
struct Accumulators {
    std::uint64_t phase = kForwardPhase;
    std::uint64_t velocity = 0;
    std::uint64_t acceleration = 0;
};

/// Executes `ticks` of velocity += acceleration, phase += velocity. Returns the carries of the phase, the last tick's
/// in bit 0. In C++ on a host, in assembler on a board.
extern "C" std::uint32_t lockstep_add_ticks(Accumulators* axis, std::uint32_t ticks);

class Engine {
public:
    explicit Engine(std::int64_t now) : now_(now), end_(now) {}

    void begin(const Piece& piece) {
        end_ = now_ + piece.ticks;
        axis_.velocity = piece.velocity;
        axis_.acceleration = piece.acceleration;
    }
    void halt() { end_ = now_; }
    /// At rest: time passes without motion.
    void wait(std::int64_t until) { now_ = end_ = until; }
    /// At rest: sets the place without a step.
    void rebase(Place at) {
        count_ = at.count;
        axis_.phase = at.phase;
    }

    /// Executes ticks until `until`, the end of the piece or a pause. Calls take(block), which returns TakenSteps, for
    /// steps in order. Steps behind a pause are made by the next run.
    template <typename Take>
    void run(std::int64_t until, Take&& take) {
        for (bool is_going = true; is_going && now_ < until && !is_idle();) {
            is_going = run_block(block_until(until), take);
        }
    }

    std::int64_t now() const { return now_; }
    bool is_idle() const { return now_ == end_; }
    Place place() const { return {.count = count_, .phase = axis_.phase}; }
    /// 0 at rest.
    std::uint64_t velocity() const { return is_idle() ? 0 : axis_.velocity; }

private:
    std::uint32_t block_until(std::int64_t until) const {
        const std::int64_t ticks = (until < end_ ? until : end_) - now_;
        return ticks < kBlockTicks ? static_cast<std::uint32_t>(ticks) : kBlockTicks;
    }
    bool is_backward() const { return axis_.velocity >> 63 != 0; }
    std::uint32_t execute(std::uint32_t& ticks);
    StepBlock block_of(std::uint32_t steps, std::uint32_t ticks) const;

    template <typename Take>
    bool run_block(std::uint32_t ticks, Take&& take) {
        const Accumulators before = axis_;
        if (const std::uint32_t steps = execute(ticks); steps != 0) {
            const StepBlock block = block_of(steps, ticks);
            const TakenSteps taken = take(block);
            count_ += block.direction < 0 ? -std::int64_t{taken.steps} : std::int64_t{taken.steps};
            if (taken.pauses) {
                stop_after(block.after[taken.steps - 1], ticks, before);
                return false;
            }
        }
        now_ += ticks;
        return true;
    }
    void stop_after(std::uint32_t n, std::uint32_t ticks, const Accumulators& before) {
        if (n < ticks) {
            axis_ = before;
            execute(n);
        }
        now_ += n;
    }

    std::int64_t now_;
    std::int64_t end_;
    std::int64_t count_ = 0;
    Accumulators axis_;
};

}  // namespace lockstep::firmware
