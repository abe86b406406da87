// Finds blocks of protobuf's text format that are not closed, and braces that close no block.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

/// A place in a text, from 1.
struct TextPlace {
    int line = 1;
    int column = 1;
    bool operator==(const TextPlace&) const = default;
};

struct BlockBalance {
    struct Block {
        std::string key;  // as in "axis {"
        TextPlace place;  // of the key
        char close = '}';
    };
    std::vector<Block> open;           // at the end of the text, the outermost first
    std::optional<TextPlace> surplus;  // the first brace that closes no block
    TextPlace end;                     // of the text
};

/// Ignores braces in strings and comments. The rest of the text may have errors.
BlockBalance block_balance(std::string_view text);

/// "Expected "}": the text ends within run (line 8) within step (line 7); add the 2 missing ends"
std::string text_of_open(const BlockBalance& balance);

}  // namespace lockstep
