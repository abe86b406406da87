#include "services/record/reading/steps/step_span.hpp"

#include <limits>

namespace lockstep::analysis {
namespace {

constexpr std::size_t kTogether = 64;

/// Compares many numbers without a branch for each.
template <typename Number>
std::size_t equal_numbers(std::span<const Number> a, std::span<const Number> b, Number difference) {
    std::size_t equal = 0;
    for (; equal + kTogether <= a.size(); equal += kTogether) {
        Number other = 0;
        for (std::size_t i = equal; i < equal + kTogether; ++i) {
            other |= static_cast<Number>((a[i] - b[i]) ^ difference);
        }
        if (other != 0) { break; }
    }
    while (equal < a.size() && a[equal] - b[equal] == difference) { ++equal; }
    return equal;
}

}  // namespace

std::size_t equal_steps(const StepSpan& a, const StepSpan& b, Ticks later) {
    const std::size_t most = std::min(a.size(), b.size());
    const std::int64_t difference = (b.origin() - a.origin() + later).value;
    if (std::abs(difference) > std::numeric_limits<std::int32_t>::max()) { return 0; }
    const std::size_t equal =
        equal_numbers<std::int32_t>({a.ticks(), most}, {b.ticks(), most}, static_cast<std::int32_t>(difference));
    if (a.is_one_way() && b.is_one_way()) { return equal > 0 && a.direction(0) == b.direction(0) ? equal : 0; }
    std::size_t alike = 0;
    while (alike < equal && a.direction(alike) == b.direction(alike)) { ++alike; }
    return alike;
}

}  // namespace lockstep::analysis
