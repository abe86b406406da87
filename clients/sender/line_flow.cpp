#include "clients/sender/line_flow.hpp"

#include <utility>

#include "clients/sender/line_text.hpp"

namespace lockstep::sender {

std::string LineFlow::take() {
    std::string bytes;
    while (!waiting_.empty() && may_send(waiting_.front())) {
        bytes += waiting_.front().text + "\n";
        sent_bytes_ += waiting_.front().text.size() + 1;
        sent_.push_back(std::move(waiting_.front()));
        waiting_.pop_front();
    }
    return bytes;
}

bool LineFlow::may_send(const Line& line) const {
    if (sent_bytes_ + line.text.size() + 1 > room_) { return false; }
    if (sent_.empty()) { return true; }
    return !one_by_one_ && !is_sent_alone(line.text) && !is_sent_alone(sent_.back().text);
}

const Line* LineFlow::too_long() const {
    const bool is_so = !waiting_.empty() && waiting_.front().text.size() + 1 > room_;
    return is_so ? &waiting_.front() : nullptr;
}

std::optional<Line> LineFlow::answer() {
    if (sent_.empty()) { return std::nullopt; }
    Line line = std::move(sent_.front());
    sent_.pop_front();
    sent_bytes_ -= line.text.size() + 1;
    ++answered_;
    return line;
}

}  // namespace lockstep::sender
