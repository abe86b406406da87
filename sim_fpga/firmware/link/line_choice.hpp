// Which of a board's lines has its host: the one by which the last frame came.
//
// A second host that speaks at the same time must not disturb the first one. So a line that has the host keeps it until
// no frame has come by it for a while.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lockstep::firmware {

class LineChoice {
public:
    enum class Verdict : std::uint8_t { Same, Changed, Ignored };

    /// A host with nothing to send still sends a frame every 5 ms (Link::kIdle_us).
    static constexpr std::uint32_t kPatience_us = 100'000;

    /// A frame with the right CRC has come by this line. Changed: another line had the host.
    Verdict take(std::size_t line, std::uint32_t now_us) {
        const bool is_other = line != line_;
        if (is_other && has_host(now_us)) { return Verdict::Ignored; }
        line_ = line;
        has_host_ = true;
        spoke_us_ = now_us;
        return is_other ? Verdict::Changed : Verdict::Same;
    }
    /// Whether a host has spoken within its patience.
    bool has_host(std::uint32_t now_us) const { return has_host_ && now_us - spoke_us_ < kPatience_us; }
    /// The line that has the host. Before any frame has come: the first line.
    std::size_t line() const { return line_; }

private:
    std::size_t line_ = 0;
    bool has_host_ = false;
    std::uint32_t spoke_us_ = 0;
};

}  // namespace lockstep::firmware
