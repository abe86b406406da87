// Collects problems: at most one for a key, and no consequential ones.
#pragma once

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
                key + " is " + number_text(value) + "; it goes from " + number_text(min) + " to " + number_text(max));
    }

    /// The first key is reported. Checked only if each of the keys is valid by itself.
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
