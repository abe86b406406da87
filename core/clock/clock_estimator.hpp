// What another clock reads, estimated from exchanges of messages with it, and how wrong that may be.
//
// An exchange is four times, as in NTP (RFC 5905): sent and arrived by the own clock, received and answered by the
// other. It proves that, then, the other clock was ahead by
//
//     at least answered - arrived   and at most   received - sent,
//
// however the delay was shared between the two ways. The estimate is the middle of what all exchanges kept prove
// together, each widened by what its age may have added; the bound is half of that span, so the true error never
// exceeds it as long as the two rates differ by at most kMaxRate and neither clock steps by less than a round trip
// (that looks like delay). Of each stretch of the window only the exchange that proves most is kept: the one with the
// least round trip, or, as long as little is known of the rates, a newer one. So the bound comes to about half the
// least round trip.
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
    /// The most that two clocks' rates may differ by: twice what a cheap quartz is specified for.
    static constexpr double kMaxRate = 200e-6;

    /// tick_ns: both clocks' tick, nominally.
    explicit ClockEstimator(std::int64_t tick_ns);

    /// Exchanges that cannot be (answered before received, arrived before sent) are left out. When a clock was set, all
    /// before is forgotten.
    void take(const ClockExchange& exchange);

    /// How an exchange goes with those before: one that contradicts them is doubtful; when a second says the same, a
    /// clock was set.
    enum class Finding : std::uint8_t { Agrees, Doubtful, ClockSet };
    /// As `take`, but when a clock was set what is known stays: for whoever can tell which, and by how much.
    Finding offer(const ClockExchange& exchange);
    /// The own clock was set forward by so much, which is known within `error`: what was learned by it holds on.
    void own_was_set(Ticks by, Ticks error);

    /// Whether there has been an exchange; before that nothing else may be asked.
    bool known() const { return !kept_.empty(); }

    struct Reading {
        Tick other;   // what the other clock reads
        Ticks error;  // at most so far off, either way
    };
    /// When the own clock reads `own`.
    Reading at(Tick own) const;
    /// The same for a while around that instant.
    ClockView view(Tick own) const {
        const Reading then = at(own);
        return {own, then.other, rate_, then.error, rate_error_};
    }

    /// The other clock's ticks in one own tick, minus 1.
    double rate() const { return rate_; }
    /// At most so far off, either way.
    double rate_error() const { return rate_error_; }
    /// How often one of the clocks was found to have been set.
    std::uint64_t steps() const { return steps_; }

private:
    static constexpr std::size_t kKept = 40;  // one of each stretch of the window, and a few that came out of turn

    /// Relative to the first exchange, so that fractions of a tick are kept.
    struct Sample {
        double own = 0;
        double ahead = 0;  // the other clock, of the own, beyond what it was at first
        double half = 0;   // ahead is right within this
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
    double stretch_;  // of which one exchange is kept
    Tick own_origin_;
    Tick other_origin_;
    StaticVector<Sample, kKept> kept_;
    std::optional<Sample> doubtful_;  // contradicts those kept: was a clock set?
    double doubt_ = 0;                // how far it is from them
    double rate_ = 0;
    double rate_error_ = kMaxRate;
    double newest_ = 0;  // of those kept; later the span only widens:
    Span then_;          // what they prove then
    std::uint64_t steps_ = 0;
};

}  // namespace lockstep
