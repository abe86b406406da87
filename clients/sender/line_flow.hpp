// Limits the lines on their way to a controller: as many as its receive buffer takes, or one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

namespace lockstep::sender {

struct Line {
    std::int64_t number = 0;  // in the file
    std::string text;
};

class LineFlow {
public:
    static constexpr std::size_t kUsualRoom = 127;  // of a controller that does not report its size

    explicit LineFlow(bool one_by_one) : one_by_one_(one_by_one) {}

    /// Sets the number of bytes that the controller's buffer takes.
    void set_room(std::size_t bytes) { room_ = bytes; }
    std::size_t room() const { return room_; }

    bool wants_line() const { return !is_ended_ && waiting_.size() < kAhead; }
    void add(Line line) { waiting_.push_back(std::move(line)); }
    /// No more lines follow.
    void end() { is_ended_ = true; }

    /// The bytes to send now.
    std::string take();
    /// Returns the next line if it is longer than the buffer and so can never be sent, otherwise null.
    const Line* too_long() const;
    /// Call it when the controller has answered the oldest line on its way. Returns that line, or nullopt if there is
    /// none.
    std::optional<Line> answer();
    bool is_done() const { return is_ended_ && waiting_.empty() && sent_.empty(); }
    std::int64_t answered() const { return answered_; }
    /// The line that was sent first of those not answered yet; null if there is none.
    const Line* oldest() const { return sent_.empty() ? nullptr : &sent_.front(); }

private:
    bool may_send(const Line& line) const;
    static constexpr std::size_t kAhead = 64;

    bool one_by_one_;
    std::size_t room_ = kUsualRoom;
    std::deque<Line> waiting_;
    std::deque<Line> sent_;
    std::size_t sent_bytes_ = 0;
    std::int64_t answered_ = 0;
    bool is_ended_ = false;
};

}  // namespace lockstep::sender
