#include "core/step/many/vector_walk.hpp"

#include <algorithm>

#include "core/step/many/edge_buffer.hpp"
#include "core/step/walk_roots.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/step/many/vector_walk.cpp"
#include <hwy/foreach_target.h>
// Above: this file again for each instruction set. Below: once in each pass.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace lockstep::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::ScalableTag<double>;
using Words = hn::ScalableTag<std::uint64_t>;
using Integers = hn::ScalableTag<std::int64_t>;
using DoubleVec = hn::Vec<Doubles>;
using WordVec = hn::Vec<Words>;
constexpr Doubles kDoubles;
constexpr Words kWords;
constexpr Integers kIntegers;

/// StepSeed::batch for the steps whose distances are g.
HWY_INLINE HWY_ATTR WordVec seeds_at(const StepSeed& seed, DoubleVec g) {
    const auto w = hn::Set(kDoubles, seed.w);
    const auto square = hn::MulAdd(hn::Set(kDoubles, 2.0 * seed.a), g, hn::Mul(w, w));
    const auto s = hn::Sqrt(hn::Max(square, hn::Zero(kDoubles)));
    const auto x =
        seed.curved ? hn::Mul(hn::Sub(s, w), hn::Set(kDoubles, seed.inverse_a)) : hn::Div(hn::Add(g, g), hn::Add(w, s));
    const auto whole = hn::ConvertTo(kIntegers, hn::Min(x, hn::Set(kDoubles, seed.last)));
    return hn::Add(hn::BitCast(kWords, whole), hn::Set(kWords, 1));
}

/// Stretch::carries_at for a vector of ticks.
HWY_INLINE HWY_ATTR hn::Mask<Words> carries_at(const Stretch& stretch, WordVec n) {
    const auto one = hn::Set(kWords, 1);
    const auto before = hn::Sub(n, one);
    const auto a = hn::Set(kWords, static_cast<std::uint64_t>(stretch.acceleration));
    const auto u = hn::Set(kWords, stretch.speed);
    const auto speed = hn::Add(u, hn::Mul(before, a));
    const auto pairs = hn::Mul(hn::ShiftRight<1>(n), hn::Or(before, one));
    const auto travel = hn::Add(hn::Mul(n, u), hn::Mul(pairs, a));
    return hn::Lt(hn::Add(hn::Set(kWords, stretch.phase), travel), speed);
}

HWY_INLINE HWY_ATTR WordVec packed(const Stretch& stretch, Tick start, WordVec n) {
    const auto ticks = hn::Add(n, hn::Set(kWords, static_cast<std::uint64_t>(start.value)));
    return hn::Add(hn::Add(ticks, ticks), hn::Set(kWords, stretch.backward ? 1 : 0));
}

/// The steps first ... first + count - 1, from a vector whose seeds are not all right.
HWY_ATTR void settle(const Stretch& stretch, Tick start, std::int64_t first, std::size_t count, WordVec n,
                     std::int64_t* out) {
    HWY_ALIGN std::uint64_t seeds[hn::MaxLanes(kWords)];
    hn::Store(n, kWords, seeds);
    for (std::size_t i = 0; i < count; ++i) {
        const auto k = first + static_cast<std::int64_t>(i);
        const std::int64_t tick = settle_step(stretch, k, static_cast<std::int64_t>(seeds[i]));
        out[i] = EdgeBuffer::pack(start + Ticks{tick}, stretch.backward);
    }
}

HWY_ATTR void walk_vectors(const Stretch& stretch, std::size_t steps, Tick start, std::int64_t* out) {
    const StepSeed seed(stretch);
    const std::size_t lanes = hn::Lanes(kWords);
    for (std::size_t done = 0; done < steps; done += lanes) {
        const std::size_t count = std::min(lanes, steps - done);
        const auto n = seeds_at(seed, hn::Iota(kDoubles, seed.gap + static_cast<double>(done)));
        const auto settled = hn::Or(carries_at(stretch, n), hn::Not(hn::FirstN(kWords, count)));
        if (hn::AllTrue(kWords, settled)) {
            hn::StoreU(hn::BitCast(kIntegers, packed(stretch, start, n)), kIntegers, out + done);
        } else {
            settle(stretch, start, static_cast<std::int64_t>(done) + 1, count, n, out + done);
        }
    }
}

}  // namespace lockstep::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace lockstep {

HWY_EXPORT(walk_vectors);

void vector_walk(const Stretch& stretch, std::size_t steps, Tick start, std::int64_t* out) {
    HWY_DYNAMIC_DISPATCH(walk_vectors)(stretch, steps, start, out);
}

}  // namespace lockstep
#endif
