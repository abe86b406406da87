// The part of a document that a program writes, between two comments, and whether it still holds.
#pragma once

#include <expected>
#include <string>
#include <string_view>

namespace lockstep::planners {

inline constexpr std::string_view kBlockBegin = "<!-- lockstep-planner-times writes from here -->\n";
inline constexpr std::string_view kBlockEnd = "<!-- to here -->\n";

/// The block without its comments. Error: the document has no block.
std::expected<std::string, std::string> block_of(std::string_view document);
/// The document with another block. Error: it has none.
std::expected<std::string, std::string> with_block(std::string_view document, std::string_view block);

/// The first difference between two tables, empty where there is none: words are the same, and numbers differ by at
/// most 0.5 % of their value, or 0.011.
std::string first_difference(std::string_view written, std::string_view now);

}  // namespace lockstep::planners
