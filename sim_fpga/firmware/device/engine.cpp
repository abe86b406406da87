#include "sim_fpga/firmware/device/engine.hpp"

#include "sim_fpga/firmware/device/abilities.hpp"
#include "sim_fpga/firmware/device/wide.hpp"

namespace lockstep::firmware {
namespace {

bool is_negative(std::uint64_t velocity) { return velocity >> 63 != 0; }

/// The lowest bits. ticks: 1 to 32.
std::uint32_t all_of(std::uint32_t ticks) { return ~std::uint32_t{0} >> (kBlockTicks - ticks); }

}  // namespace

/// Velocity is linear in time, so that its last value decides: the first is a word of 64 bits. The product of most
/// pieces has 63 bits, which takes a quarter of the time.
bool is_executable(const Piece& piece) {
    if (piece.ticks < 1 || piece.ticks > kLongestPiece) { return false; }
    constexpr std::int64_t kFewTicks = std::int64_t{1} << 20;
    constexpr std::uint64_t kSmall = std::uint64_t{1} << 43;
    if (piece.ticks < kFewTicks && piece.acceleration + kSmall < 2 * kSmall) {
        const std::uint64_t gained = piece.acceleration * static_cast<std::uint64_t>(piece.ticks);
        const std::uint64_t last = piece.velocity + gained;
        return is_negative(piece.velocity) != is_negative(gained) || is_negative(last) == is_negative(gained);
    }
    const Wide gained = product_of(static_cast<std::int64_t>(piece.acceleration), piece.ticks);
    return is_narrow(widened(static_cast<std::int64_t>(piece.velocity)) + gained);
}

/// Returns the ticks with a step, the last one in bit 0. A step forward is a carry of the phase. A step backward is a
/// borrow, which is a sum without a carry. If the velocity changes its sign, it is the next tick alone that is
/// executed: `ticks` becomes 1.
std::uint32_t Engine::execute(std::uint32_t& ticks) {
    const Accumulators before = axis_;
    const bool begins_backward = (axis_.velocity + axis_.acceleration) >> 63 != 0;
    std::uint32_t carries = lockstep_add_ticks(&axis_, ticks);
    if (begins_backward != is_backward()) {
        axis_ = before;
        ticks = 1;
        carries = lockstep_add_ticks(&axis_, ticks);
    }
    return begins_backward ? carries ^ all_of(ticks) : carries;
}

/// Steps are rare, so that ticks without one are skipped eight at a time.
StepBlock Engine::block_of(std::uint32_t steps, std::uint32_t ticks) const {
    constexpr std::uint32_t kSkipped = 8;
    StepBlock block;
    block.begin = now_;
    block.direction = is_backward() ? -1 : 1;
    block.size = 0;
    steps <<= kBlockTicks - ticks;  // the next tick is the highest bit
    for (std::uint32_t n = 1; steps != 0; ++n, steps <<= 1) {
        for (; steps >> (kBlockTicks - kSkipped) == 0; n += kSkipped) { steps <<= kSkipped; }
        for (; steps >> (kBlockTicks - 1) == 0; ++n) { steps <<= 1; }
        block.after[block.size++] = static_cast<std::uint8_t>(n);
    }
    return block;
}

}  // namespace lockstep::firmware
