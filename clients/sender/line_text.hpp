// A line of a file as a controller of grbl's protocol gets it.
#pragma once

#include <expected>
#include <string>
#include <string_view>

namespace lockstep::sender {

/// Returns the line without comments and without blanks at its ends; empty if there is nothing to send. Fails if it has
/// a byte that the controller obeys at any place in a line: '!', '?', '~', 0x18, or one above 0x7F.
std::expected<std::string, std::string> line_to_send(std::string_view line);

/// Whether the line ends its program: M2 or M30, unless the line is deletable.
bool ends_program(std::string_view line);

/// The controller stores a value and may lose bytes meanwhile, so no other line may be on its way.
bool is_sent_alone(std::string_view line);

}  // namespace lockstep::sender
