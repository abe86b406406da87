// A line to a host, and a frame on its way there.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/link/frame.hpp"

namespace lockstep::firmware {

class Line {
public:
    /// The next byte that was received. Returns false if there is none.
    [[nodiscard]] virtual bool receive(std::uint8_t& byte) = 0;
    /// Sends bytes, the last of which ends a frame: as many as the line takes now. Returns how many.
    virtual std::size_t send(const std::uint8_t* bytes, std::size_t size) = 0;

protected:
    ~Line() = default;
};

class Transmission {
public:
    Frame& frame() { return frame_; }
    bool is_done() const { return next_ >= frame_.size; }
    void begin() { next_ = 0; }
    /// The rest of the frame is not sent.
    void drop() { next_ = frame_.size; }
    void advance(Line& line) {
        if (!is_done()) { next_ += line.send(frame_.bytes + next_, frame_.size - next_); }
    }

private:
    Frame frame_;
    std::size_t next_ = 0;
};

}  // namespace lockstep::firmware
