#include "services/documents/edit/key_edit.hpp"

#include <algorithm>
#include <cstddef>

#include "idl/proto/machine.pb.h"
#include "services/documents/text/text_source.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kNone = std::string_view::npos;
constexpr std::string_view kValue = "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_.+-";

/// Returns the byte offset of a place. In Protobuf's columns a tab extends to the next multiple of 8.
std::size_t offset_of(std::string_view text, const TextSource::Place& place) {
    constexpr int kTab = 8;
    std::size_t at = 0;
    for (int line = 1; line < place.line; ++line) { at = text.find('\n', at) + 1; }
    for (int column = 0; column < place.column - 1; ++at) { column += text[at] == '\t' ? kTab - column % kTab : 1; }
    return at;
}

std::size_t find_key(std::string_view text, const std::string& path) {
    TextSource source;
    proto::Machine machine;
    (void)source.parse(text, machine);
    const TextSource::Place place = source.place_of(*proto::Machine::descriptor(), path);
    return place.is_of_key ? offset_of(text, place) : kNone;
}

/// `content` includes its key.
void add_to_block(std::string& text, const std::string& block, const std::string& content) {
    const std::size_t open = text.find_first_of("{<", find_key(text, block));
    text.insert(open + 1, " " + content);
}

}  // namespace

bool has_key(std::string_view text, const std::string& path) { return find_key(text, path) != kNone; }

bool set_key(std::string& text, const std::string& path, const std::string& value) {
    const std::size_t point = path.rfind('.');
    const std::string block = path.substr(0, point);
    const std::string key = path.substr(point + 1);
    if (const std::size_t at = find_key(text, path); at != kNone) {
        const std::size_t begin = text.find_first_not_of(" \t\r\n:", at + key.size());
        const std::size_t end = std::min(text.find_first_not_of(kValue, begin), text.size());
        if (begin == end) { return false; }
        text.replace(begin, end - begin, value);
    } else if (has_key(text, block)) {
        add_to_block(text, block, key + ": " + value);
    } else {
        const std::size_t outer = block.rfind('.');
        add_to_block(text, block.substr(0, outer), block.substr(outer + 1) + " { " + key + ": " + value + " }");
    }
    return true;
}

}  // namespace lockstep
