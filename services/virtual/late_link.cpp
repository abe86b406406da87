#include "services/virtual/late_link.hpp"

#include <algorithm>
#include <utility>

#include "core/protocol/frame_room.hpp"

namespace lockstep {
namespace {

std::uint64_t entries_of(const DeviceOrder& order) {
    const auto* frame = std::get_if<device::LoadFrame>(&order);
    return frame == nullptr ? 0 : ring_entries(frame->track);
}

}  // namespace

LateLink::Ways LateLink::draw() {
    const auto whole = static_cast<std::uint64_t>((delay_.most - delay_.least).value + 1);
    const Ticks both = delay_.least + Ticks{static_cast<std::int64_t>(random_() % whole)};
    const Ticks there{static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(both.value + 1))};
    return {there, both - there};
}

void LateLink::send(Tick arrives, std::variant<Question, DeviceOrder> content) {
    if (!sent_.empty()) { arrives = std::max(arrives, sent_.back().arrives); }
    sent_.push_back({arrives, std::move(content)});
}

void LateLink::attach(DeviceDriver driver) {
    driver_.emplace(std::move(driver));
    refusal_.reset();
    is_asked_ = false;
    ++questions_;
    answer_.reset();
}

void LateLink::ask(Tick now, Tick own) {
    const Ways ways = draw();
    is_asked_ = true;
    send(now + ways.there, Question{++questions_, own, ways.back});
}

void LateLink::give(Tick now, const DeviceOrder& order) {
    segments_ += entries_of(order);
    send(now + draw().there, order);
}

void LateLink::hold_until(Tick until) {
    for (Message& message : sent_) { message.arrives = std::max(message.arrives, until); }
}

void LateLink::arrive() {
    const Message message = std::move(sent_.front());
    sent_.pop_front();
    if (const auto* question = std::get_if<Question>(&message.content)) { return answer(*question, message.arrives); }
    const auto& order = std::get<DeviceOrder>(message.content);
    arrived_segments_ += entries_of(order);
    const auto given = driver_->apply(order);
    if (!given) { refusal_ = given.error(); }
}

/// Steps and changes of channels are read for each question, even if the process that asked it has ended.
void LateLink::answer(const Question& question, Tick now) {
    Answer answer{.status = driver_->read(),
                  .asked = question.asked,
                  .arrives = now + question.back,
                  .lost_captures = driver_->lost_captures(),
                  .lost_channel_events = driver_->lost_events(),
                  .segments = arrived_segments_};
    const auto captured = driver_->drain_capture([this](StepEdge step) { steps_.push_back(step); });
    if (!captured) { answer.status = std::unexpected(captured.error()); }
    const auto noted = driver_->drain_events([this](const ChannelEvent& event) { channel_events_.push_back(event); });
    if (!noted) { answer.status = std::unexpected(noted.error()); }
    answer.channel_events = noted_ += noted.value_or(0);
    if (refusal_) { answer.status = std::unexpected(*refusal_); }
    captured_ += captured.value_or(0);
    answer.captured = captured_;
    answer.free_captures = static_cast<std::uint32_t>(driver_->abilities().capture_entries - captured.value_or(0));
    if (question.number == questions_) { answer_ = std::move(answer); }
}

std::optional<LateLink::Answer> LateLink::take_answer(Tick now) {
    if (!answer_ || answer_->arrives > now) { return std::nullopt; }
    is_asked_ = false;
    return std::exchange(answer_, std::nullopt);
}

void LateLink::pass_steps(std::uint64_t captured, const DevicePort::OnStep& on_step) {
    for (std::uint64_t passed = captured_ - steps_.size(); passed < captured; ++passed) {
        on_step(steps_.front());
        steps_.pop_front();
    }
}

void LateLink::pass_channels(std::uint64_t events, const DevicePort::OnChannel& on_channel) {
    for (std::uint64_t passed = noted_ - channel_events_.size(); passed < events; ++passed) {
        on_channel(channel_events_.front());
        channel_events_.pop_front();
    }
}

std::expected<std::optional<DeviceReading>, std::string> LatePort::read(Tick own) {
    if (auto answer = link_.take_answer(now_())) { newest_ = std::move(answer); }
    if (!link_.is_asked()) { link_.ask(now_(), own); }
    if (!newest_) { return std::nullopt; }
    if (!newest_->status) { return std::unexpected(newest_->status.error()); }
    return reading_of(*newest_);
}

/// Orders that the device did not have yet when it answered count as well.
DeviceReading LatePort::reading_of(const LateLink::Answer& answer) const {
    DeviceReading reading{*answer.status, answer.asked, process_clock_(answer.arrives)};
    reading.status.run_asked = run_.value_or(reading.status.run_asked);
    const auto on_their_way = static_cast<std::uint32_t>(link_.segments() - answer.segments);
    reading.status.free_segments -= std::min(reading.status.free_segments, on_their_way);
    return reading;
}

std::expected<void, std::string> LatePort::apply(const DeviceOrder& order) {
    if (const auto* begin = std::get_if<device::BeginRun>(&order)) { run_ = begin->run; }
    link_.give(now_(), order);
    return {};
}

std::expected<std::uint32_t, std::string> LatePort::drain(const OnStep& on_step) {
    if (!newest_) { return static_cast<std::uint32_t>(registers::kCaptureRingMostEntries); }
    link_.pass_steps(newest_->captured, on_step);
    return newest_->free_captures;
}

std::expected<void, std::string> LatePort::drain_channels(const OnChannel& on_channel) {
    if (newest_) { link_.pass_channels(newest_->channel_events, on_channel); }
    return {};
}

}  // namespace lockstep
