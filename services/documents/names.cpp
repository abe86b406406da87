#include "services/documents/names.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <optional>

namespace lockstep {
namespace {

constexpr char small(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }
constexpr bool is_letter(char c) { return small(c) >= 'a' && small(c) <= 'z'; }
constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_name(std::string_view name, std::size_t longest, std::string_view marks) {
    const auto may_stand = [&](char c) { return is_letter(c) || is_digit(c) || marks.contains(c); };
    return !name.empty() && name.size() <= longest && is_letter(name.front()) && std::ranges::all_of(name, may_stand);
}

std::optional<in_addr> four_of(const std::string& text) {
    in_addr address{};
    return inet_pton(AF_INET, text.c_str(), &address) == 1 ? std::optional(address) : std::nullopt;
}

std::optional<in6_addr> six_of(const std::string& text) {
    in6_addr address{};
    return inet_pton(AF_INET6, text.c_str(), &address) == 1 ? std::optional(address) : std::nullopt;
}

}  // namespace

bool is_axis_name(std::string_view name) { return is_name(name, kMaxAxisName, "_"); }

bool is_machine_name(std::string_view name) { return is_name(name, kMaxMachineName, "_-"); }

bool is_host_name(std::string_view name) {
    constexpr std::size_t kLongest = 253;
    const auto may_stand = [](char c) { return is_letter(c) || is_digit(c) || c == '-' || c == '.'; };
    return !name.empty() && name.size() <= kLongest && std::ranges::all_of(name, may_stand) &&
           !std::string_view("-.").contains(name.front());
}

bool is_ip_address(const std::string& text) { return four_of(text) || six_of(text); }

bool is_loopback_address(const std::string& text) {
    if (const auto four = four_of(text)) { return ntohl(four->s_addr) >> 24 == IN_LOOPBACKNET; }
    const auto six = six_of(text);
    return six && IN6_IS_ADDR_LOOPBACK(&*six);
}

bool same_name(std::string_view one, std::string_view other) {
    return std::ranges::equal(one, other, {}, small, small);
}

std::optional<AxisIndex> axis_in_any_case(const MachineConfig& machine, std::string_view name) {
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        if (same_name(machine.axes[i].name, name)) { return i; }
    }
    return std::nullopt;
}

}  // namespace lockstep
