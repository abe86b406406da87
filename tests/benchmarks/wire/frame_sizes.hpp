// The measured frames: about 2 KB on the wire, for a machine of 3 axes and for one of 32.
#pragma once

#include "core/protocol/messages.hpp"

namespace lockstep {

/// A frame with `pieces` body pieces per axis and a tail of one piece.
inline Frame frame_of(std::size_t axes, std::size_t pieces) {
    const Piece piece{{5000}, {1 << 30}, {1 << 10}};
    Frame frame{.number = 1, .ticks = {5000}, .axes = std::vector<AxisTrack>(axes)};
    for (AxisTrack& axis : frame.axes) {
        while (axis.body.size() < pieces) { (void)axis.body.push_back(piece); }
        (void)axis.tail.push_back(piece);
    }
    return frame;
}

inline Frame frame_of_3_axes() { return frame_of(3, 26); }
inline Frame frame_of_32_axes() { return frame_of(32, 1); }

}  // namespace lockstep
