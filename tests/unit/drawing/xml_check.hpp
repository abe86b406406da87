// Checks that the elements of an XML document nest and its text is escaped.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep::test {

/// Whether every '&' begins one of XML's predefined entities.
inline bool entities_are_known(std::string_view text) {
    for (std::size_t at = text.find('&'); at != text.npos; at = text.find('&', at + 1)) {
        const std::string_view rest = text.substr(at);
        if (!rest.starts_with("&amp;") && !rest.starts_with("&lt;") && !rest.starts_with("&gt;") &&
            !rest.starts_with("&quot;")) {
            return false;
        }
    }
    return true;
}

/// The error in the document, or nullopt if it is well-formed.
inline std::optional<std::string> xml_problem(std::string_view xml) {
    if (!entities_are_known(xml)) { return "a bare '&'"; }
    std::vector<std::string> open;
    for (std::size_t at = xml.find('<'); at != xml.npos; at = xml.find('<', at + 1)) {
        const std::size_t end = xml.find('>', at);
        if (end == xml.npos) { return "an element without an end"; }
        std::string_view tag = xml.substr(at + 1, end - at - 1);
        if (tag.find('<') != tag.npos) { return "a bare '<'"; }
        const std::string name(
            tag.substr(tag.starts_with('/') ? 1 : 0, tag.find_first_of(" /\n", 1) - (tag.starts_with('/') ? 1 : 0)));
        if (tag.starts_with('/')) {
            if (open.empty() || open.back() != tag.substr(1)) {
                return "</" + std::string(tag.substr(1)) + "> unasked";
            }
            open.pop_back();
        } else if (!tag.ends_with('/')) {
            open.push_back(name);
        }
    }
    return open.empty() ? std::nullopt : std::optional("<" + open.back() + "> stays open");
}

}  // namespace lockstep::test
