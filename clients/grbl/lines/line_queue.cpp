#include "clients/grbl/lines/line_queue.hpp"

#include <algorithm>

namespace lockstep::grbl {
namespace {

constexpr std::int32_t kRenumber = 1'000'000'000;

}  // namespace

bool LineQueue::has_room() const {
    if (lines_.size() < kPlannerLines) { return blocks_ < kMostBlocks; }
    return lines_.size() < kMostLines && blocks_ < kMostBlocks && seconds_ < kSeconds;
}

std::int32_t LineQueue::add(const LineToRun& line, std::optional<std::uint64_t> request) {
    if (lines_.empty() && last_ > kRenumber) { last_ = 0; }
    lines_.push_back({++last_, line.sender_line, line.seconds, line.blocks.size(), request});
    seconds_ += line.seconds;
    blocks_ += line.blocks.size();
    return last_;
}

std::vector<std::uint64_t> LineQueue::pass_to(std::int32_t number) {
    std::vector<std::uint64_t> requests;
    while (!lines_.empty() && lines_.front().number < number) {
        const Line& line = lines_.front();
        if (line.request) { requests.push_back(*line.request); }
        seconds_ -= line.seconds;
        blocks_ -= line.blocks;
        lines_.pop_front();
    }
    if (lines_.empty()) { seconds_ = 0; }
    return requests;
}

std::vector<std::uint64_t> LineQueue::drop() {
    std::vector<std::uint64_t> requests;
    for (const Line& line : lines_) {
        if (line.request) { requests.push_back(*line.request); }
    }
    lines_.clear();
    seconds_ = 0;
    blocks_ = 0;
    return requests;
}

std::int32_t LineQueue::sender_line(std::int32_t number) const {
    const auto found = std::ranges::find(lines_, number, &Line::number);
    return found == lines_.end() ? number : found->sender_line.value_or(number);
}

}  // namespace lockstep::grbl
