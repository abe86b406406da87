// Collects problems: at most one for each key, and none that only follows from another.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "core/number_text.hpp"
#include "services/documents/machine_rules.hpp"

namespace lockstep {

class ProblemList {
public:
    /// `prefix` begins every message.
    explicit ProblemList(std::optional<std::size_t> axis = {}, std::string prefix = {})
        : axis_(axis), prefix_(std::move(prefix)) {}

    bool is_sound(std::string_view key) const {
        return std::ranges::none_of(problems_, [&](const Problem& problem) { return problem.field.key == key; });
    }

    void require(bool holds, std::string_view key, const std::string& message) {
        if (!holds && is_sound(key)) { problems_.push_back({{axis_, std::string(key)}, prefix_ + message}); }
    }

    void require_range(const std::string& key, double value, double min, double max) {
        require(value >= min && value <= max, key,
                fmt::format("{} is {}; it must be from {} to {}", key, number_text(value), number_text(min),
                            number_text(max)));
    }

    /// Checks a rule between several keys, but only if none of them has a problem yet. Reports the problem at the first
    /// key.
    void require_between(std::initializer_list<std::string_view> keys, bool holds, const std::string& message) {
        const bool can_be_judged = std::ranges::all_of(keys, [this](std::string_view key) { return is_sound(key); });
        require(holds || !can_be_judged, *keys.begin(), message);
    }

    bool empty() const { return problems_.empty(); }
    std::vector<Problem> take() { return std::move(problems_); }

private:
    std::optional<std::size_t> axis_;
    std::string prefix_;
    std::vector<Problem> problems_;
};

}  // namespace lockstep
