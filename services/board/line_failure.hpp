// Errors in opening a line to a board.
#pragma once

#include <expected>
#include <string>

#include "core/device/link_name.hpp"

namespace lockstep {

inline std::unexpected<std::string> line_failure(const std::string& path, const std::string& why,
                                                 const std::string& remedy) {
    return std::unexpected(path + ": " + why + "; " + remedy);
}

inline std::unexpected<std::string> line_is_held(const std::string& path) {
    return line_failure(path, "another program uses it",
                        "end it, or the machine if it is lockstep-board (lockstep down), and try again");
}

/// A serial line or an SPI that cannot be opened; `error` is the errno of the attempt.
std::unexpected<std::string> line_not_opened(LinkName::Kind kind, const std::string& path, int error);

}  // namespace lockstep
