// Estimates of another clock, the machine time that follows from them, and the pace of frames by a device's clock stay
// as recorded. To write the files: LOCKSTEP_WRITE_HASHES=1 build/bin/property_clock --gtest_filter='*StayAsRecorded'
#include "core/axis/device/frame_pace.hpp"
#include "core/clock/clock_asker.hpp"
#include "core/clock/machine_time.hpp"
#include "tests/property/clock/two_clocks.hpp"
#include "tests/property/recorded_hashes.hpp"
#include "tests/property/recorded_text.hpp"

namespace lockstep {
namespace {

constexpr std::uint32_t kClocks = 200;
constexpr std::uint32_t kPaces = 400;

void record(RecordedText& text, const ClockView& view) {
    text.line(view.own, view.other, view.rate * 1e6, view.error, view.rate_error * 1e6);
}

/// Whole microseconds per second, so that nine digits show each of them.
void record(RecordedText& text, const ClockEstimator& clock, Tick own) {
    const ClockEstimator::Reading reading = clock.at(own);
    text.line(reading.other, reading.error, clock.rate() * 1e6, clock.rate_error() * 1e6, clock.steps());
}

/// Some exchanges come late, twice, or are impossible; now and then a clock is set.
std::string estimates_of(std::uint32_t number) {
    TwoClocks clocks(number);
    ClockEstimator taken(kTick_ns);
    ClockEstimator offered(kTick_ns);
    MachineTime time(kTick_ns, number % 8 == 0 ? TimeSource::Shared : TimeSource::Network, Ticks{7});
    RecordedText text;
    std::optional<ClockExchange> late;
    const auto one_of = [&](double n) { return clocks.real(0, n) < 1; };
    for (int k = 0; k < 120; ++k) {
        if (one_of(60)) { clocks.step(clocks.real(-1e6, 1e6)); }
        ClockExchange exchange = clocks.exchange();
        if (one_of(30)) { std::swap(exchange.sent, exchange.arrived); }
        if (one_of(10)) { late = exchange; }
        const bool is_late = late && one_of(6);
        const ClockExchange& given = is_late ? *late : exchange;
        taken.take(given);
        time.take(given);
        text.line(taken.known(), offered.offer(given), time.known(), time.is_own_clock());
        const Tick own = clocks.own(clocks.truth());
        if (one_of(40)) {
            offered.own_was_set(Ticks{5000}, Ticks{40});
            time.own_was_set(Ticks{5000}, Ticks{40});
        }
        if (!taken.known() || !offered.known() || !time.known()) { continue; }
        record(text, taken, own);
        record(text, offered, own + Ticks{100'000});
        text.line(time.advance(own, one_of(2)));
        text.line(time.error(own), time.at(own + Ticks{3000}), time.own_at(time.at(own) + Ticks{2000}));
        record(text, time.estimate(own));
    }
    return text.text();
}

std::string paces_of(std::uint32_t number) {
    TwoClocks clocks(number);
    const Ticks frame{static_cast<std::int64_t>(clocks.real(500, 50'000))};
    AxisLimits limits{.start_velocity = 0.01, .max_velocity = clocks.real(0.02, 0.4)};
    limits.max_acceleration = limits.max_deceleration = clocks.real(1e-8, 1e-5);
    FramePace pace(frame, limits);
    Tick machine{1'000'000};
    pace.begin(machine, clocks.drift());
    double off = clocks.real(-30, 30);
    RecordedText text;
    for (int k = 0; k < 60; ++k) {
        const Ticks lasts = clocks.real(0, 4) < 1 ? Ticks{static_cast<std::int64_t>(clocks.real(20, 2000))} : frame;
        machine = machine + lasts;
        off += clocks.real(-1, 1);
        const auto asked = static_cast<std::int64_t>(static_cast<double>(machine.value) * (1 + clocks.drift()) + off);
        const auto pieces = static_cast<std::size_t>(clocks.real(1, 20));
        const FramePace::Part part{lasts, pieces, Tick{asked}, clocks.drift()};
        const Retiming tail = pace.tail(part);
        const Retiming body = pace.body(part);
        text.line(tail.start, tail.end, tail.bend * 1e6, tail.bow(), body.start, body.end, body.bend * 1e6, body.bow());
        if (clocks.real(0, 12) < 1) { pace.keep(Ticks{static_cast<std::int64_t>(clocks.real(0, 100))}); }
        text.line(pace.end());
    }
    return text.text();
}

std::string requests_of(std::uint32_t number) {
    TwoClocks clocks(number);
    ClockAsker asker(3, 55, kTick_ns);
    std::vector<ClockRequest> open;
    RecordedText text;
    Tick own{1000};
    for (int k = 0; k < 200; ++k) {
        own += Ticks{static_cast<std::int64_t>(clocks.real(0, 30'000))};
        if (const auto request = asker.ask(own)) {
            text.line(request->axis, request->identity, request->sequence, request->sent);
            open.push_back(*request);
        }
        if (open.empty() || clocks.real(0, 3) < 1) { continue; }
        const ClockRequest& of = open[static_cast<std::size_t>(clocks.real(0, static_cast<double>(open.size())))];
        ClockReply reply{of, own + Ticks{7}, own + Ticks{9}};
        if (clocks.real(0, 20) < 1) { ++reply.request.axis; }
        if (clocks.real(0, 20) < 1) { ++reply.request.identity; }
        const auto exchange = asker.receive(reply, own);
        text.line(exchange.has_value());
        if (exchange) { text.line(exchange->sent, exchange->received, exchange->answered, exchange->arrived); }
    }
    return text.text();
}

TEST(EstimatesOfClocks, StayAsRecorded) {
    expect_recorded("tests/property/clock/estimates.txt", kClocks, estimates_of);
}
TEST(PacesOfFrames, StayAsRecorded) { expect_recorded("tests/property/clock/paces.txt", kPaces, paces_of); }
TEST(RequestsForTime, StayAsRecorded) { expect_recorded("tests/property/clock/requests.txt", kClocks, requests_of); }

}  // namespace
}  // namespace lockstep
