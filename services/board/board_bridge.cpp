#include "services/board/board_bridge.hpp"

#include <algorithm>
#include <random>
#include <thread>
#include <utility>

#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

/// A session's number: never 0.
std::uint32_t drawn_number() {
    std::random_device random;
    return random() | 1;
}

/// In a step: more than may be under way (Link::kMostInFlight).
constexpr int kMostFrames = 10;

std::uint32_t microseconds(BoardBridge::Time time) { return static_cast<std::uint32_t>(time.count() / 1000); }

}  // namespace

BoardBridge::BoardBridge(LinkName name, std::vector<RegisterWindow> windows, Time patience)
    : name_(std::move(name)), patience_(patience), words_(std::move(windows)), link_(words_, drawn_number()) {
    words_.show_link(false);
}

void BoardBridge::step() {
    if (!has_line(monotonic_now())) {
        std::this_thread::sleep_for(std::chrono::milliseconds{kMostWait_ms});
    } else {
        line_->wait(kMostWait_ms);
        receive();
    }
    const Time now = monotonic_now();
    firmware::Frame frame;
    for (int left = kMostFrames; left > 0 && line_ && line_->is_free(); --left) {
        if (!link_.next_frame(microseconds(now), frame)) { break; }
        line_->send(frame);
    }
    watch_answers(now);
}

bool BoardBridge::has_line(Time now) {
    if (line_) { return true; }
    if (tried_ && now - *tried_ < kOpenPeriod) { return false; }
    tried_ = now;
    auto opened = LinkLine::open(name_);
    if (!opened) {
        if (!answers_) { lack_ = opened.error(); }
        return false;
    }
    line_.emplace(std::move(*opened));
    if (!answers_) {
        lack_ = "the line is open, but no board answers; check that it has Lockstep's firmware and power";
    }
    return true;
}

void BoardBridge::receive() {
    const auto bytes = line_->receive();
    const Time now = monotonic_now();  // behind the arrival of the bytes
    if (!bytes) {
        line_.reset();
        return;
    }
    received_ += bytes->size();
    words_.receive_at(now.count());
    for (const std::uint8_t byte : *bytes) { link_.take(byte, microseconds(now)); }
}

/// Only time in which this process ran counts.
void BoardBridge::watch_answers(Time now) {
    constexpr Time kLongestStep = std::chrono::milliseconds{10};
    silent_ += std::min(now - std::exchange(stepped_, now), kLongestStep);
    if (link_.is_connected() && link_.peer_stamp() != answered_) {
        answered_ = link_.peer_stamp();
        silent_ = {};
        lack_.clear();
    }
    const bool answers = link_.is_connected() && silent_ <= patience_;
    if (answers == answers_) { return; }
    answers_ = answers;
    if (!answers) { lack_ = "it fell silent; check its cable and its power"; }
    words_.show_link(answers);
}

}  // namespace lockstep
