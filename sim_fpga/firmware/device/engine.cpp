#include "sim_fpga/firmware/device/engine.hpp"

#include "sim_fpga/firmware/device/abilities.hpp"
#include "sim_fpga/firmware/device/wide.hpp"

namespace lockstep::firmware {
namespace {

bool is_backward(std::uint64_t velocity) { return velocity >> 63 != 0; }

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
        return is_backward(piece.velocity) != is_backward(gained) || is_backward(last) == is_backward(gained);
    }
    const Wide gained = product_of(static_cast<std::int64_t>(piece.acceleration), piece.ticks);
    return is_narrow(widened(static_cast<std::int64_t>(piece.velocity)) + gained);
}

/// A step forward is a carry of the phase. A step backward is a borrow, which is a sum without a carry.
Engine::Block Engine::execute(std::uint32_t ticks) {
    const Accumulators before = axis_;
    const bool begins_backward = is_backward(axis_.velocity + axis_.acceleration);
    const std::uint32_t carries = lockstep_add_ticks(&axis_, ticks);
    if (begins_backward != is_backward(axis_.velocity)) {
        axis_ = before;
        return execute_across_rest(ticks);
    }
    const std::uint32_t backward = begins_backward ? all_of(ticks) : 0;
    return {.steps = carries ^ backward, .backward = backward};
}

/// The velocity changes its sign, so each tick has its own.
Engine::Block Engine::execute_across_rest(std::uint32_t ticks) {
    Block block;
    for (; ticks > 0; --ticks) {
        const std::uint32_t carry = lockstep_add_ticks(&axis_, 1);
        const std::uint32_t backward = is_backward(axis_.velocity) ? 1 : 0;
        block = {.steps = block.steps << 1 | (carry ^ backward), .backward = block.backward << 1 | backward};
    }
    return block;
}

}  // namespace lockstep::firmware
