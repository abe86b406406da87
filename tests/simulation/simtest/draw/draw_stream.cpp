#include "tests/simulation/simtest/draw/draw_stream.hpp"

#include <algorithm>

namespace lockstep::simtest {

void send_in_parts(Draw& draw, Task& task) {
    std::vector<Block>& blocks = task.program.blocks;
    const double settles = draw.chance(0.5) ? 0 : 0.3;
    for (std::size_t left = blocks.size(); left > 0;) {
        const std::size_t most = std::max<std::size_t>(1, blocks.size() / static_cast<std::size_t>(draw.whole(1, 8)));
        SentPart part{.blocks = std::min(left, 1 + draw.index(most)), .after_s = 0};
        left -= part.blocks;
        if (draw.chance(0.6)) { part.after_s = draw.magnitude(0.001, 2); }
        if (draw.chance(settles)) {
            const auto end = blocks.end() - static_cast<std::ptrdiff_t>(left);
            blocks.insert(end, {std::prev(end)->line, Settle{}});
            ++part.blocks;
        }
        task.parts.push_back(part);
    }
    if (draw.chance(0.2)) { task.parts.insert(task.parts.begin(), SentPart{}); }
    if (draw.chance(0.3)) { task.parts.push_back({.blocks = 0, .after_s = draw.magnitude(0.001, 2)}); }
}

}  // namespace lockstep::simtest
