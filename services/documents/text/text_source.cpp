#include "services/documents/text/text_source.hpp"

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/stubs/logging.h>

#include <algorithm>
#include <cstdlib>

#include "services/documents/text/block_balance.hpp"

namespace lockstep {
namespace {

namespace pb = google::protobuf;

constexpr int kMaxNesting = 16;
constexpr std::size_t kMaxDiagnostics = 50;

/// Protobuf counts lines and columns from 0.
class Collector : public pb::io::ErrorCollector {
public:
    void AddError(int line, pb::io::ColumnNumber column, const std::string& message) override {
        if (found.size() < kMaxDiagnostics) {
            found.push_back({std::max(line, 0) + 1, std::max(column, 0) + 1, message});
        }
    }
    Diagnostics found;
};

/// Descends from a block to a key, as far as the text has the path.
class Descent {
public:
    Descent(const pb::TextFormat::ParseInfoTree& tree, const pb::Descriptor& type) : tree_(&tree), type_(&type) {}

    /// `index` is that of a repeated key; below 0 it is the first.
    void enter(const std::string& key, int index) {
        const pb::FieldDescriptor* field = tree_ == nullptr ? nullptr : type_->FindFieldByName(key);
        if (field != nullptr) { index = field->is_repeated() ? std::max(index, 0) : -1; }
        const auto at = field == nullptr ? pb::TextFormat::ParseLocation{} : tree_->GetLocation(field, index);
        place_.is_of_key = at.line >= 0;
        if (!place_.is_of_key) {
            tree_ = nullptr;
            return;
        }
        place_.line = at.line + 1;
        place_.column = at.column + 1;
        type_ = field->message_type();
        tree_ = type_ == nullptr ? nullptr : tree_->GetTreeForNested(field, index);
    }

    TextSource::Place place() const { return place_; }

private:
    const pb::TextFormat::ParseInfoTree* tree_;
    const pb::Descriptor* type_;
    TextSource::Place place_;
};

/// Protobuf's messages end with the text that it found, which is empty at the end of the text.
bool names_the_end(const std::string& message) {
    return message.ends_with("got: ") || message.ends_with("found \"\".");
}

/// Says of errors that missing or surplus braces cause what to do.
void explain_braces(std::string_view text, Diagnostics& errors) {
    const BlockBalance balance = block_balance(text);
    const auto is_at = [](const Diagnostic& error, const TextPlace& place) {
        return TextPlace{error.line, error.column} == place;
    };
    for (Diagnostic& error : errors) {
        if (balance.surplus && is_at(error, *balance.surplus)) {
            error.message = "this brace closes no block; remove it, or add the beginning of the block";
        } else if (balance.open.empty() && is_at(error, balance.end) && names_the_end(error.message)) {
            error.message += "the end of the text";
        }
    }
    if (balance.open.empty()) { return; }
    std::erase_if(errors, [&](const Diagnostic& error) { return is_at(error, balance.end); });
    errors.push_back({balance.end.line, balance.end.column, text_of_open(balance)});
}

}  // namespace

Diagnostics TextSource::parse(std::string_view text, pb::Message& message) {
    const pb::LogSilencer what_is_wrong_is_the_answer;
    Collector errors;
    pb::TextFormat::Parser parser;
    parser.RecordErrorsTo(&errors);
    parser.WriteLocationsTo(&places_);
    parser.SetRecursionLimit(kMaxNesting);
    pb::io::ArrayInputStream stream(text.data(), static_cast<int>(text.size()));
    if (!parser.Parse(&stream, &message) && errors.found.empty()) {
        errors.found.push_back({.message = "the text cannot be read"});
    }
    if (!errors.found.empty()) { explain_braces(text, errors.found); }
    return errors.found;
}

TextSource::Place TextSource::place_of(const pb::Descriptor& type, std::string_view path) const {
    Descent descent(places_, type);
    while (!path.empty()) {
        const std::string_view key = path.substr(0, path.find('.'));
        path.remove_prefix(std::min(key.size() + 1, path.size()));
        const std::size_t bracket = std::min(key.find('['), key.size());
        const bool repeats = bracket < key.size();
        descent.enter(std::string(key.substr(0, bracket)), repeats ? std::atoi(&key[bracket + 1]) : -1);
    }
    return descent.place();
}

}  // namespace lockstep
