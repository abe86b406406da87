#include "clients/report_page/page_parts.hpp"

namespace lockstep::analysis {

std::string within_page(const std::string& json) {
    std::string out;
    out.reserve(json.size());
    for (const char c : json) {
        if (c == '<') {
            out += "\\u003c";
        } else {
            out.push_back(c);
        }
    }
    return out;
}

std::string filled(std::string_view page, const std::map<std::string_view, std::string>& texts) {
    std::string out;
    for (;;) {
        const std::size_t from = page.find('@');
        const std::size_t to = from == page.npos ? page.npos : page.find('@', from + 1);
        const auto text = to == page.npos ? texts.end() : texts.find(page.substr(from + 1, to - from - 1));
        if (to == page.npos) { return out.append(page); }
        if (text == texts.end()) {
            out.append(page.substr(0, to));
            page.remove_prefix(to);
            continue;
        }
        out.append(page.substr(0, from)).append(text->second);
        page.remove_prefix(to + 1);
    }
}

}  // namespace lockstep::analysis
