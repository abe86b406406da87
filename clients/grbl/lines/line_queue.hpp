// Counts a sender's lines that were accepted and are not run yet, and about how long they take.
//
// It takes kPlannerLines, and more while all together last less than kSeconds. The machine moves only as fast as it can
// stop within the lines that it knows.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "clients/grbl/protocol/request.hpp"

namespace lockstep::grbl {

class LineQueue {
public:
    static constexpr std::size_t kMostLines = 4096;
    static constexpr std::size_t kMostBlocks = 200'000;  // of arcs
    static constexpr double kSeconds = 3;

    bool has_room() const;
    /// Returns the line's number, which its blocks get. Numbers rise from 1. `request`: to be answered when the line
    /// was run.
    std::int32_t add(const LineToRun& line, std::optional<std::uint64_t> request);
    /// Call when the machine runs this line. Removes the lines before it, and returns the requests to answer.
    std::vector<std::uint64_t> pass_to(std::int32_t number);
    /// Call when this line and all before it are done.
    std::vector<std::uint64_t> pass(std::int32_t number) { return pass_to(number + 1); }
    /// Drops all lines. Returns the requests that wait for them.
    std::vector<std::uint64_t> drop();

    std::size_t size() const { return lines_.size(); }
    /// The line's number for the sender: its N word, or the number from add() if it has none.
    std::int32_t sender_line(std::int32_t number) const;

private:
    struct Line {
        std::int32_t number = 0;
        std::optional<std::int32_t> sender_line;
        double seconds = 0;
        std::size_t blocks = 0;
        std::optional<std::uint64_t> request;
    };
    std::deque<Line> lines_;
    std::int32_t last_ = 0;
    double seconds_ = 0;
    std::size_t blocks_ = 0;
};

}  // namespace lockstep::grbl
