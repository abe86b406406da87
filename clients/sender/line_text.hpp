// A line of a file as a controller of grbl's protocol gets it.
#pragma once

#include <expected>
#include <string>
#include <string_view>

namespace lockstep::sender {

/// Without comments and without blanks at its ends. Empty: there is nothing to send. Error: it has a byte that the
/// controller would obey wherever it stands: '!', '?', '~', 0x18, or one above 0x7F.
std::expected<std::string, std::string> line_to_send(std::string_view line);

/// The controller stores something meanwhile, and may lose bytes: nothing else may be on its way.
bool is_sent_alone(std::string_view line);

}  // namespace lockstep::sender
