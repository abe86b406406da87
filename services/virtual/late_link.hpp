// A link to a device that takes time in both directions, like that of a board, in virtual time: orders and questions
// reach the device in order, later than they were sent, and answers come back still later.
//
// The link belongs to the device and outlives the processes of its axis. A port is the axis's end of it.
#pragma once

#include <cstdint>
#include <deque>
#include <expected>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <variant>

#include "services/axis/device_driver.hpp"
#include "services/axis/device_port.hpp"

namespace lockstep {

/// From a question to its answer: drawn for each question, and divided at random between the two ways. `most` 0: no
/// link.
struct LinkDelay {
    Ticks least;
    Ticks most;
};

class LateLink {
public:
    LateLink(LinkDelay delay, std::uint64_t seed) : delay_(delay), random_(seed) {}

    // The device's end. Times are true.

    /// When the next message reaches the device.
    std::optional<Tick> next() const { return sent_.empty() ? std::nullopt : std::optional(sent_.front().arrives); }
    /// The device, which has run up to next(), gets this message.
    void arrive();
    /// The device takes no message before `until`.
    void hold_until(Tick until);
    /// The device was powered up: what was on its way is lost.
    void power_up() { sent_.clear(); }

    // The axis's end.

    /// A new process uses the link. Orders of the process before it still arrive; answers to its questions do not.
    void attach(DeviceDriver driver);
    /// `own`: the present reading of the process's clock, which the answer contains.
    void ask(Tick now, Tick own);
    void give(Tick now, const DeviceOrder& order);

    struct Answer {
        std::expected<DeviceStatus, std::string> status;
        Tick asked;                       // by the process's clock
        Tick arrives;                     // true time
        std::uint64_t captured = 0;       // the steps that the device had made up to then
        std::uint32_t free_captures = 0;  // before these steps were read
        std::uint64_t lost_captures = 0;
        std::uint64_t channel_events = 0;  // the changes of inputs and outputs up to then
        std::uint64_t lost_channel_events = 0;
        std::uint64_t segments = 0;  // those that had reached the device
    };
    /// The answer to the last question; nullopt: it has not arrived by `now`, or was taken.
    std::optional<Answer> take_answer(Tick now);
    bool is_asked() const { return is_asked_; }
    /// Passes the steps that have not been passed yet, up to this number in all.
    void pass_steps(std::uint64_t captured, const DevicePort::OnStep& on_step);
    /// The same for changes of inputs and outputs.
    void pass_channels(std::uint64_t events, const DevicePort::OnChannel& on_channel);
    /// Segments given so far.
    std::uint64_t segments() const { return segments_; }

private:
    struct Question {
        std::uint64_t number = 0;
        Tick asked;
        Ticks back;  // the way of the answer
    };
    struct Message {
        Tick arrives;
        std::variant<Question, DeviceOrder> content;
    };
    struct Ways {
        Ticks there;
        Ticks back;
    };
    Ways draw();
    void send(Tick arrives, std::variant<Question, DeviceOrder> content);
    void answer(const Question& question, Tick now);

    LinkDelay delay_;
    std::mt19937_64 random_;
    std::optional<DeviceDriver> driver_;
    std::optional<std::string> refusal_;  // of an order
    std::deque<Message> sent_;
    bool is_asked_ = false;
    std::uint64_t questions_ = 0;
    std::optional<Answer> answer_;
    std::deque<StepEdge> steps_;  // that have crossed the link and were not passed yet
    std::uint64_t captured_ = 0;
    std::deque<ChannelEvent> channel_events_;  // likewise
    std::uint64_t noted_ = 0;
    std::uint64_t segments_ = 0;
    std::uint64_t arrived_segments_ = 0;
};

/// The axis's end of a link.
class LatePort : public DevicePort {
public:
    /// `now`: the true time. `process_clock`: what the process's clock reads at a true time. The link must outlive the
    /// port.
    LatePort(LateLink& link, std::function<Tick()> now, std::function<Tick(Tick)> process_clock)
        : link_(link), now_(std::move(now)), process_clock_(std::move(process_clock)) {}

    DeviceClock clock() const override { return DeviceClock::Own; }
    std::expected<std::optional<DeviceReading>, std::string> read(Tick own) override;
    std::expected<void, std::string> apply(const DeviceOrder& order) override;
    std::expected<std::uint32_t, std::string> drain(const OnStep& on_step) override;
    std::uint64_t lost_captures() const override { return newest_ ? newest_->lost_captures : 0; }
    std::expected<void, std::string> drain_channels(const OnChannel& on_channel) override;
    std::uint64_t lost_channel_events() const override { return newest_ ? newest_->lost_channel_events : 0; }

private:
    DeviceReading reading_of(const LateLink::Answer& answer) const;

    LateLink& link_;
    std::function<Tick()> now_;
    std::function<Tick(Tick)> process_clock_;
    std::optional<LateLink::Answer> newest_;
    std::optional<std::uint64_t> run_;  // the last run asked for through this port
};

}  // namespace lockstep
