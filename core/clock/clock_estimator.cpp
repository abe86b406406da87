#include "core/clock/clock_estimator.hpp"

#include <algorithm>
#include <cmath>

namespace lockstep {
namespace {

constexpr double kWindow_s = 8;
constexpr double kStretch_s = 0.25;
constexpr double kStampRounding = 1;  // ticks: a clock shows the last tick that has begun
constexpr double kWander = 1e-6;      // change of a quartz's rate within the window, by temperature

double ticks_in(double seconds, std::int64_t tick_ns) { return seconds * 1e9 / static_cast<double>(tick_ns); }

double between(Tick from, Tick to) { return static_cast<double>((to - from).value); }

}  // namespace

ClockEstimator::ClockEstimator(std::int64_t tick_ns)
    : window_(ticks_in(kWindow_s, tick_ns)), stretch_(ticks_in(kStretch_s, tick_ns)) {}

ClockEstimator::Sample ClockEstimator::sample_of(const ClockExchange& exchange) const {
    const double sent = between(own_origin_, exchange.sent);
    const double arrived = between(own_origin_, exchange.arrived);
    const double least = between(other_origin_, exchange.answered) - arrived - kStampRounding;
    const double most = between(other_origin_, exchange.received) - sent + kStampRounding;
    return {(sent + arrived) / 2, (least + most) / 2, (most - least) / 2 + kMaxRate * (arrived - sent)};
}

void ClockEstimator::take(const ClockExchange& exchange) {
    if (offer(exchange) != Finding::ClockSet) { return; }
    kept_.clear();
    doubtful_.reset();
    doubt_ = 0;
    keep(sample_of(exchange));
}

ClockEstimator::Finding ClockEstimator::offer(const ClockExchange& exchange) {
    if (exchange.arrived < exchange.sent || exchange.answered < exchange.received) { return Finding::Agrees; }
    if (!known()) {
        own_origin_ = exchange.sent;
        other_origin_ = exchange.received;
        keep(sample_of(exchange));
        return Finding::Agrees;
    }
    const Sample sample = sample_of(exchange);
    const Span expected = ahead_at(sample.own);
    const double apart =
        std::max({0.0, expected.low - sample.ahead - sample.half, sample.ahead - sample.half - expected.high});
    if (apart == 0) {
        doubtful_.reset();
        doubt_ = 0;
        keep(sample);
        return Finding::Agrees;
    }
    const bool twice = doubtful_ && agree(*doubtful_, sample);
    doubtful_ = sample;
    doubt_ = apart + 2 * sample.half;
    if (twice) { ++steps_; }
    return twice ? Finding::ClockSet : Finding::Doubtful;
}

void ClockEstimator::own_was_set(Ticks by, Ticks error) {
    own_origin_ += by;
    for (Sample& sample : kept_) { sample.half += static_cast<double>(error.value); }
    doubtful_.reset();
    doubt_ = 0;
    if (known()) { fit(); }
}

bool ClockEstimator::agree(const Sample& one, const Sample& other) const {
    const double drift = kMaxRate * std::abs(one.own - other.own);
    return std::abs(one.ahead - other.ahead) <= one.half + other.half + drift;
}

/// Compares the bounds of two samples on the clocks' difference. The older bound has grown since its exchange. Unless
/// the newer bound is smaller than the older one was, it must be smaller than the grown one by at least a tick.
bool ClockEstimator::proves_more(const Sample& newer, const Sample& older) const {
    const double widened = rate_error_ * (newer.own - older.own);
    return newer.half < older.half || newer.half + kStampRounding < older.half + widened;
}

/// Keeps, of each stretch of time, the sample that now proves most. Discards samples that have left the window.
void ClockEstimator::keep(const Sample& sample) {
    const auto stretch_of = [this](const Sample& s) { return std::floor(s.own / stretch_); };
    const bool same_stretch = !kept_.empty() && stretch_of(kept_.back()) == stretch_of(sample);
    if (same_stretch && !proves_more(sample, kept_.back())) { return; }
    if (same_stretch) { kept_.pop_back(); }
    const auto is_young = [&](const Sample& s) { return s.own >= sample.own - window_; };
    const auto outdated = static_cast<std::size_t>(std::ranges::find_if(kept_, is_young) - kept_.begin());
    kept_.erase_front(std::max<std::size_t>(outdated, kept_.full() ? 1 : 0));
    kept_.append(sample);
    fit();
}

/// Fits the rate to the exchanges, within the bounds that they prove.
void ClockEstimator::fit() {
    const Span proven = proven_rates();
    rate_ = std::clamp(slope(), proven.low, proven.high);
    rate_error_ = std::max(proven.high - rate_, rate_ - proven.low) + kWander;
    newest_ = std::ranges::max(kept_, {}, &Sample::own).own;
    then_ = proven_at(newest_);
}

/// Any two exchanges bound the rate: by the least lead then and the greatest lead now, and the other way round.
ClockEstimator::Span ClockEstimator::proven_rates() const {
    Span rates{-kMaxRate, kMaxRate};
    for (std::size_t i = 0; i < kept_.size(); ++i) {
        for (std::size_t j = i + 1; j < kept_.size(); ++j) {
            const double time = kept_[j].own - kept_[i].own;
            if (time <= 0) { continue; }
            const double gained = kept_[j].ahead - kept_[i].ahead;
            const double slack = kept_[j].half + kept_[i].half;
            rates.low = std::max(rates.low, (gained - slack) / time);
            rates.high = std::min(rates.high, (gained + slack) / time);
        }
    }
    return {std::min(rates.low, rates.high), std::max(rates.low, rates.high)};
}

/// Linear regression. Each exchange is weighted by how narrow its bounds are. One exchange has no slope; its sums would
/// differ by rounding alone.
double ClockEstimator::slope() const {
    if (kept_.size() < 2) { return 0; }
    double weights = 0;
    double own = 0;
    double ahead = 0;
    for (const Sample& s : kept_) {
        const double weight = 1 / (s.half * s.half);
        weights += weight;
        own += weight * s.own;
        ahead += weight * s.ahead;
    }
    own /= weights;
    ahead /= weights;
    double together = 0;
    double spread = 0;
    for (const Sample& s : kept_) {
        const double weight = 1 / (s.half * s.half);
        together += weight * (s.own - own) * (s.ahead - ahead);
        spread += weight * (s.own - own) * (s.own - own);
    }
    return spread > 0 ? together / spread : 0;
}

/// Computes the span that all kept samples allow together. After the newest sample the span only shifts and widens.
ClockEstimator::Span ClockEstimator::ahead_at(double own) const {
    if (own < newest_) { return proven_at(own); }
    const double since = own - newest_;
    return {then_.low + (rate_ - rate_error_) * since, then_.high + (rate_ + rate_error_) * since};
}

ClockEstimator::Span ClockEstimator::proven_at(double own) const {
    Span all{-1e300, 1e300};
    for (const Sample& s : kept_) {
        const double time = own - s.own;
        const double slack = s.half + rate_error_ * std::abs(time);
        all.low = std::max(all.low, s.ahead + rate_ * time - slack);
        all.high = std::min(all.high, s.ahead + rate_ * time + slack);
    }
    return {std::min(all.low, all.high), std::max(all.low, all.high)};
}

ClockEstimator::Reading ClockEstimator::at(Tick own) const {
    const double since = between(own_origin_, own);
    const Span ahead = ahead_at(since);
    const auto other = static_cast<std::int64_t>(std::llround(ahead.middle()));
    const auto error = static_cast<std::int64_t>(std::ceil(ahead.width() / 2 + doubt_ + kStampRounding));
    return {other_origin_ + (own - own_origin_) + Ticks{other}, {error}};
}

}  // namespace lockstep
