#include "services/documents/text/block_balance.hpp"

#include <fmt/format.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

namespace lockstep {
namespace {

namespace pb = google::protobuf;
using pb::io::Tokenizer;

class NoErrors : public pb::io::ErrorCollector {
public:
    void AddError(int /*line*/, pb::io::ColumnNumber /*column*/, const std::string& /*message*/) override {}
};

TextPlace place_of(const Tokenizer::Token& token) { return {token.line + 1, token.column + 1}; }

/// The brace that ends a block which begins with this one; 0 if it begins none.
char close_of(const std::string& token) { return token == "{" ? '}' : token == "<" ? '>' : '\0'; }

class Balancing {
public:
    void take(const Tokenizer::Token& token) {
        if (token.type == Tokenizer::TYPE_IDENTIFIER) { key_ = {token.text, place_of(token)}; }
        if (token.type != Tokenizer::TYPE_SYMBOL) { return; }
        if (const char close = close_of(token.text); close != '\0') {
            key_.close = close;
            balance_.open.push_back(key_);
        } else if (token.text == "}" || token.text == ">") {
            end_block(token);
        }
    }
    BlockBalance end(const Tokenizer::Token& token) && {
        balance_.end = place_of(token);
        return std::move(balance_);
    }

private:
    void end_block(const Tokenizer::Token& token) {
        const bool closes = !balance_.open.empty() && balance_.open.back().close == token.text.front();
        if (closes) { return balance_.open.pop_back(); }
        if (!balance_.surplus) { balance_.surplus = place_of(token); }
    }

    BlockBalance::Block key_;  // the last key
    BlockBalance balance_;
};

}  // namespace

BlockBalance block_balance(std::string_view text) {
    pb::io::ArrayInputStream stream(text.data(), static_cast<int>(text.size()));
    NoErrors errors;
    Tokenizer tokenizer(&stream, &errors);
    tokenizer.set_comment_style(Tokenizer::SH_COMMENT_STYLE);
    Balancing balancing;
    while (tokenizer.Next()) { balancing.take(tokenizer.current()); }
    return std::move(balancing).end(tokenizer.current());
}

std::string text_of_open(const BlockBalance& balance) {
    std::string blocks;
    for (auto block = balance.open.rbegin(); block != balance.open.rend(); ++block) {
        blocks += fmt::format(" within {} (line {})", block->key, block->place.line);
    }
    const char close = balance.open.empty() ? '}' : balance.open.back().close;
    const std::string missing = balance.open.size() == 1 ? fmt::format("missing {}", close)
                                                         : fmt::format("{} missing ends", balance.open.size());
    return fmt::format("Expected \"{}\": the text ends{}; add the {}", close, blocks, missing);
}

}  // namespace lockstep
