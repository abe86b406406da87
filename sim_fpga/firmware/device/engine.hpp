// The add-only step engine, tick by tick in blocks: equal to core/step/tick_engine.hpp, for processors of 32 bits.
#pragma once

#include <cstdint>

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

/// The most ticks in a block.
inline constexpr std::uint32_t kBlockTicks = 32;

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

    /// Executes ticks until `until` or the end of the piece. Calls on_step(tick, direction) for each step. It returns
    /// false to stop the engine right after this tick.
    template <typename OnStep>
    void run(std::int64_t until, OnStep&& on_step) {
        for (bool is_going = true; is_going && now_ < until && !is_idle();) {
            is_going = run_block(block_until(until), on_step);
        }
    }

    std::int64_t now() const { return now_; }
    bool is_idle() const { return now_ == end_; }
    Place place() const { return {.count = count_, .phase = axis_.phase}; }
    /// 0 at rest.
    std::uint64_t velocity() const { return is_idle() ? 0 : axis_.velocity; }

private:
    /// The last tick of a block is bit 0 of both.
    struct Block {
        std::uint32_t steps = 0;
        std::uint32_t backward = 0;
    };

    std::uint32_t block_until(std::int64_t until) const {
        const std::int64_t ticks = (until < end_ ? until : end_) - now_;
        return ticks < kBlockTicks ? static_cast<std::uint32_t>(ticks) : kBlockTicks;
    }
    Block execute(std::uint32_t ticks);
    Block execute_across_rest(std::uint32_t ticks);

    template <typename OnStep>
    bool run_block(std::uint32_t ticks, OnStep&& on_step) {
        const Accumulators before = axis_;
        const Block block = execute(ticks);
        const std::uint32_t unused = kBlockTicks - ticks;
        std::uint32_t steps = block.steps << unused;  // the next tick is the highest bit
        for (std::uint32_t n = 1; steps != 0; ++n, steps <<= 1) {
            for (; steps >> (kBlockTicks - 8) == 0; n += 8) { steps <<= 8; }
            for (; steps >> (kBlockTicks - 1) == 0; ++n) { steps <<= 1; }
            const bool is_backward = (block.backward >> (ticks - n) & 1) != 0;
            count_ += is_backward ? -1 : 1;
            if (!on_step(now_ + n, is_backward ? -1 : 1)) {
                stop_after(n, ticks, before);
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
