// Estimates what another clock reads from message exchanges with it, and bounds the error of the estimate.
//
// An exchange has four times, as in NTP (RFC 5905): sent and arrived by the own clock, received and answered by the
// other. It proves that the other clock was ahead at that time by
//
//     at least answered - arrived   and at most   received - sent,
//
// however the delay was shared between the two directions. All kept exchanges together prove a span, each widened by
// the drift that its age allows. The estimate is the middle of the span and the bound is half its width. The true error
// never exceeds the bound if the two rates differ by at most kMaxRate and neither clock steps by less than a round
// trip, which would look like delay. In each stretch of the window the estimator keeps only the exchange that proves
// most: the one with the shortest round trip, or a newer one while little is known of the rates. So the bound
// approaches half the shortest round trip.
#pragma once

#include <cstdint>
#include <optional>

#include "core/clock/clock_view.hpp"
#include "core/static_vector.hpp"
#include "core/units.hpp"

namespace lockstep {

struct ClockExchange {
    Tick sent;      // own clock
    Tick received;  // the other's
    Tick answered;  // the other's
    Tick arrived;   // own clock
};

class ClockEstimator {
public:
    /// The greatest difference between the rates of two clocks: twice what a cheap quartz is specified for.
    static constexpr double kMaxRate = 200e-6;

    /// `tick_ns`: the nominal tick of both clocks.
    explicit ClockEstimator(std::int64_t tick_ns);

    /// Ignores impossible exchanges (answered before received, arrived before sent). When a clock was set, discards all
    /// earlier exchanges.
    void take(const ClockExchange& exchange);

    /// How an exchange agrees with earlier ones. One that contradicts them is doubtful. When a second one confirms it,
    /// a clock was set.
    enum class Finding : std::uint8_t { Agrees, Doubtful, ClockSet };
    /// Like `take`, but keeps all earlier exchanges when a clock was set. For callers that know which clock was set,
    /// and by how much.
    Finding offer(const ClockExchange& exchange);
    /// The own clock was set forward by `by`, which is known within `error`. Earlier exchanges remain valid.
    void own_was_set(Ticks by, Ticks error);

    /// Whether there has been an exchange. Before the first one no reading may be asked for.
    bool known() const { return !kept_.empty(); }

    struct Reading {
        Tick other;   // what the other clock reads
        Ticks error;  // `other` is off by at most this, in either direction
    };
    /// The reading of the other clock when the own clock reads `own`.
    Reading at(Tick own) const;
    /// The same, valid for a while around that instant.
    ClockView view(Tick own) const {
        const Reading then = at(own);
        return {own, then.other, rate_, then.error, rate_error_};
    }

    /// The other clock's ticks in one own tick, minus 1.
    double rate() const { return rate_; }
    /// The rate is off by at most this, in either direction.
    double rate_error() const { return rate_error_; }
    /// How often one of the clocks was found to have been set.
    std::uint64_t steps() const { return steps_; }

private:
    static constexpr std::size_t kKept = 40;  // one of each stretch of the window, and a few that came out of order

    /// Relative to the first exchange, so that doubles keep fractions of a tick.
    struct Sample {
        double own = 0;
        double ahead = 0;  // how far the other clock is ahead of the own one, minus its lead at first
        double half = 0;   // bound on the error of `ahead`
    };
    struct Span {
        double low = 0;
        double high = 0;
        double width() const { return high - low; }
        double middle() const { return (low + high) / 2; }
    };

    Sample sample_of(const ClockExchange& exchange) const;
    bool proves_more(const Sample& newer, const Sample& older) const;
    void keep(const Sample& sample);
    void fit();
    Span proven_rates() const;
    double slope() const;
    Span proven_at(double own) const;
    Span ahead_at(double own) const;
    bool agree(const Sample& one, const Sample& other) const;

    double window_;
    double stretch_;  // length of the stretches; one exchange is kept of each
    Tick own_origin_;
    Tick other_origin_;
    StaticVector<Sample, kKept> kept_;
    std::optional<Sample> doubtful_;  // contradicts the kept samples: a clock may have been set
    double doubt_ = 0;                // how far it is from the kept samples
    double rate_ = 0;
    double rate_error_ = kMaxRate;
    double newest_ = 0;  // own time of the newest kept sample
    Span then_;          // what the kept samples prove at newest_
    std::uint64_t steps_ = 0;
};

}  // namespace lockstep
