// The block of a document that a program writes between two comments, and its comparison with a newer one.
#pragma once

#include <expected>
#include <string>
#include <string_view>

namespace lockstep::planners {

inline constexpr std::string_view kBlockBegin = "<!-- lockstep-planner-times writes from here -->\n";
inline constexpr std::string_view kBlockEnd = "<!-- to here -->\n";

/// The block without its comments. Error: the document has no block.
std::expected<std::string, std::string> block_of(std::string_view document);
/// The document with another block. Error: the document has no block.
std::expected<std::string, std::string> with_block(std::string_view document, std::string_view block);

/// The first difference between two tables, or an empty text. Words must be the same. Numbers may differ by 0.5 % of
/// their value or by 0.011, whichever is more.
std::string first_difference(std::string_view written, std::string_view now);

}  // namespace lockstep::planners
