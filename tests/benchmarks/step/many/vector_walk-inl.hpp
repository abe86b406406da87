// The steps of a stretch by roots (walk_roots.hpp), as many at a time as the processor's vectors hold. Included once
// for each instruction set (foreach_target.h), therefore its guard is Highway's.
#if defined(LOCKSTEP_VECTOR_WALK_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef LOCKSTEP_VECTOR_WALK_INL_HPP
#undef LOCKSTEP_VECTOR_WALK_INL_HPP
#else
#define LOCKSTEP_VECTOR_WALK_INL_HPP
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "core/step/walk_roots.hpp"
#include "tests/benchmarks/step/many/edge_buffer.hpp"

HWY_BEFORE_NAMESPACE();
namespace lockstep::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Writes the steps first ... first + count - 1, from seeds of which not all are exact.
template <class Words>
HWY_NOINLINE HWY_ATTR void settle(Words words, Stretch stretch, Tick start, std::int64_t first, std::size_t count,
                                  hn::Vec<Words> n, std::int64_t* out) {
    HWY_ALIGN std::uint64_t seeds[hn::MaxLanes(words)];
    hn::Store(n, words, seeds);
    for (std::size_t i = 0; i < count; ++i) {
        const auto k = first + static_cast<std::int64_t>(i);
        const std::int64_t tick = settle_step(stretch, k, static_cast<std::int64_t>(seeds[i]));
        out[i] = EdgeBuffer::pack(start + Ticks{tick}, stretch.backward);
    }
}

/// vector_walk with vectors of these lanes. For each vector: StepSeed::batch, Stretch::carries_at, EdgeBuffer::pack.
template <class Doubles>
HWY_INLINE HWY_ATTR void walk_lanes(Doubles doubles, const Stretch& stretch, std::size_t steps, Tick start,
                                    std::int64_t* out) {
    const hn::RebindToUnsigned<Doubles> words;
    const hn::RebindToSigned<Doubles> integers;
    const StepSeed seed(stretch);
    const auto w = hn::Set(doubles, seed.w);
    const auto square_w = hn::Mul(w, w);
    const auto twice_a = hn::Set(doubles, 2.0 * seed.a);
    const auto inverse_a = hn::Set(doubles, seed.inverse_a);
    const auto last = hn::Set(doubles, seed.last);
    const auto one = hn::Set(words, 1);
    const auto phase = hn::Set(words, stretch.phase);
    const auto u = hn::Set(words, stretch.speed);
    const auto a = hn::Set(words, static_cast<std::uint64_t>(stretch.acceleration));
    const auto origin = hn::Set(words, static_cast<std::uint64_t>(EdgeBuffer::pack(start, stretch.backward)));
    for (std::size_t done = 0; done < steps; done += hn::Lanes(doubles)) {
        const auto g = hn::Iota(doubles, seed.gap + static_cast<double>(done));
        const auto s = hn::Sqrt(hn::Max(hn::MulAdd(twice_a, g, square_w), hn::Zero(doubles)));
        const auto x = seed.curved ? hn::Mul(hn::Sub(s, w), inverse_a) : hn::Div(hn::Add(g, g), hn::Add(w, s));
        const auto before = hn::BitCast(words, hn::ConvertTo(integers, hn::Min(x, last)));
        const auto n = hn::Add(before, one);
        const auto pairs = hn::Mul(hn::ShiftRight<1>(n), hn::Or(before, one));
        const auto after = hn::Add(hn::Add(phase, hn::Mul(n, u)), hn::Mul(pairs, a));
        const auto carries = hn::Lt(after, hn::Add(u, hn::Mul(before, a)));
        const std::size_t count = std::min(hn::Lanes(doubles), steps - done);
        if (hn::AllTrue(words, hn::Or(carries, hn::Not(hn::FirstN(words, count))))) {
            hn::StoreU(hn::BitCast(integers, hn::Add(origin, hn::Add(n, n))), integers, out + done);
        } else {
            settle(words, stretch, start, static_cast<std::int64_t>(done) + 1, count, n, out + done);
        }
    }
}

/// Writes the ticks of the steps of a stretch, packed for an EdgeBuffer. `steps` is their number. Vectors are written
/// whole, so up to EdgeBuffer::kSlack words behind the last step may be overwritten. For few steps, longer vectors
/// would compute no more roots per clock and leave more lanes empty.
HWY_INLINE HWY_ATTR void vector_walk(const Stretch& stretch, std::size_t steps, Tick start, std::int64_t* out) {
    constexpr std::size_t kFew = 4;
    if (steps > kFew) { return walk_lanes(hn::ScalableTag<double>(), stretch, steps, start, out); }
    walk_lanes(hn::CappedTag<double, kFew>(), stretch, steps, start, out);
}

}  // namespace lockstep::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // the guard
