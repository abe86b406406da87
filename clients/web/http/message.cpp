#include "clients/web/http/message.hpp"

#include <algorithm>

namespace lockstep::web {
namespace {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && text.front() == ' ') { text.remove_prefix(1); }
    while (!text.empty() && text.back() == ' ') { text.remove_suffix(1); }
    return text;
}

}  // namespace

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::ranges::transform(lower, lower.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return lower;
}

void Request::add_header(std::string_view name, std::string_view value) {
    const std::string small = lower_case(name);
    if (!headers.emplace(small, value).second) { repeated.insert(small); }
}

const std::string* Request::header(std::string_view name) const {
    const auto found = headers.find(std::string(name));
    return found == headers.end() ? nullptr : &found->second;
}

std::optional<std::string> Request::cookie(std::string_view name) const {
    const std::string* all = header("cookie");
    std::string_view rest = all == nullptr ? std::string_view{} : std::string_view(*all);
    while (!rest.empty()) {
        const std::size_t end = rest.find(';');
        const std::string_view pair = trimmed(rest.substr(0, end));
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
        const std::size_t equals = pair.find('=');
        if (equals != std::string_view::npos && pair.substr(0, equals) == name) {
            return std::string(pair.substr(equals + 1));
        }
    }
    return std::nullopt;
}

}  // namespace lockstep::web
