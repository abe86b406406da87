#include "services/board/frame_link.hpp"

#include <random>
#include <utility>

#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

/// A session's number: never 0.
std::uint32_t drawn_number() {
    std::random_device random;
    return random() | 1;
}

constexpr int kMostWait_ms = 1;
/// In an exchange: more than may be under way (Link::kMostInFlight).
constexpr int kMostFrames = 10;

std::uint32_t microseconds(std::chrono::nanoseconds time) { return static_cast<std::uint32_t>(time.count() / 1000); }

}  // namespace

FrameLink::FrameLink(LinkName name, const std::vector<RegisterWindow>& windows)
    : name_(std::move(name)), words_(windows), link_(words_, drawn_number()) {}

std::expected<void, std::string> FrameLink::open() {
    auto opened = LinkLine::open(name_);
    if (!opened) { return std::unexpected(std::move(opened.error())); }
    line_.emplace(std::move(*opened));
    return {};
}

void FrameLink::exchange() {
    line_->wait(kMostWait_ms);
    receive();
    const auto now = monotonic_now();
    firmware::Frame frame;
    for (int left = kMostFrames; left > 0 && line_ && line_->is_free(); --left) {
        if (!link_.next_frame(microseconds(now), frame)) { break; }
        line_->send(frame);
    }
    if (link_.is_connected() && link_.peer_stamp() != answered_) {
        answered_ = link_.peer_stamp();
        ++answers_;
    }
}

std::string FrameLink::lack() const {
    if (answers_ != 0) { return "it fell silent; check its cable and its power"; }
    return "the line is open, but no board answers; check that it has Lockstep's firmware and power";
}

void FrameLink::receive() {
    const auto bytes = line_->receive();
    const auto now = monotonic_now();  // behind the arrival of the bytes
    if (!bytes) {
        line_.reset();
        return;
    }
    received_ += bytes->size();
    words_.receive_at(now.count());
    for (const std::uint8_t byte : *bytes) { link_.take(byte, microseconds(now)); }
}

}  // namespace lockstep
