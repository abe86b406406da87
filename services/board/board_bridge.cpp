#include "services/board/board_bridge.hpp"

#include <algorithm>
#include <thread>
#include <utility>

#include "services/board/frame_link.hpp"
#include "services/board/spi_link.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {

std::unique_ptr<BoardLink> BoardLink::create(const LinkName& name, const std::vector<RegisterWindow>& windows) {
    if (name.kind == LinkName::Kind::Spi) { return std::make_unique<SpiLink>(name, windows); }
    return std::make_unique<FrameLink>(name, windows);
}

BoardBridge::BoardBridge(const LinkName& name, const std::vector<RegisterWindow>& windows, Time patience)
    : patience_(patience), link_(BoardLink::create(name, windows)) {
    link_->show(false);
}

void BoardBridge::step() {
    if (!has_line(monotonic_now())) {
        std::this_thread::sleep_for(std::chrono::milliseconds{1});
    } else {
        link_->exchange();
    }
    watch_answers(monotonic_now());
}

bool BoardBridge::has_line(Time now) {
    if (link_->is_open()) { return true; }
    if (tried_ && now - *tried_ < kOpenPeriod) { return false; }
    tried_ = now;
    const auto opened = link_->open();
    if (!answers_) { lack_ = opened ? link_->lack() : opened.error(); }
    return opened.has_value();
}

/// Only time in which this process ran counts.
void BoardBridge::watch_answers(Time now) {
    constexpr Time kLongestStep = std::chrono::milliseconds{10};
    silent_ += std::min(now - std::exchange(stepped_, now), kLongestStep);
    if (link_->answers() != answered_) {
        answered_ = link_->answers();
        silent_ = {};
        lack_.clear();
    }
    const bool answers = answered_ != 0 && silent_ <= patience_;
    if (!answers && (link_->is_open() || lack_.empty())) { lack_ = link_->lack(); }
    if (answers == answers_) { return; }
    answers_ = answers;
    link_->show(answers);
}

}  // namespace lockstep
