#include "core/gcode/text/parameters.hpp"

#include <algorithm>
#include <utility>

namespace lockstep::gcode {
namespace {

constexpr int kFirstSystem = 5399;  // lower numbers are values of programs and of the machine's state

bool is_global(std::string_view name) { return name.starts_with('_'); }

}  // namespace

double Parameters::numbered(int number) const {
    if (number >= kFirstSystem) {
        if (const auto value = system_.numbered(number)) { return *value; }
    }
    return values_.numbered[static_cast<std::size_t>(number)];
}

std::optional<double> Parameters::named(std::string_view name) const {
    if (const auto value = system_.named(name)) { return value; }
    const NamedValues& names = is_global(name) ? values_.global : local_;
    const auto found = names.find(name);
    return found == names.end() ? std::nullopt : std::optional(found->second);
}

void Parameters::set(std::string_view name, double value) {
    (is_global(name) ? values_.global : local_).insert_or_assign(std::string(name), value);
}

void Parameters::enter(const Arguments& arguments) {
    Caller caller{.arguments = {}, .local = std::exchange(local_, {})};
    std::copy_n(values_.numbered.begin() + 1, kArguments, caller.arguments.begin());
    std::ranges::copy(arguments, values_.numbered.begin() + 1);
    callers_.push_back(std::move(caller));
}

void Parameters::leave() {
    std::ranges::copy(callers_.back().arguments, values_.numbered.begin() + 1);
    local_ = std::move(callers_.back().local);
    callers_.pop_back();
}

}  // namespace lockstep::gcode
