// Collects problems: at most one for a key, the first.
#pragma once

#include <algorithm>

#include "core/gcode/number_text.hpp"
#include "services/documents/machine_rules.hpp"

namespace lockstep {

class ProblemList {
public:
    explicit ProblemList(std::optional<std::size_t> axis = {}, std::string prefix = {})
        : axis_(axis), prefix_(std::move(prefix)) {}

    void add(const std::string& key, const std::string& message) {
        const FieldPath field{axis_, key};
        if (std::ranges::find(problems_, field, &Problem::field) == problems_.end()) {
            problems_.push_back({field, prefix_ + message});
        }
    }

    /// For relations: false with a NaN, which its own range has reported, must mean that nothing is wrong here.
    void add_if(bool violated, const std::string& key, const std::string& message) {
        if (violated) { add(key, message); }
    }

    void require_range(const std::string& key, double value, double min, double max) {
        if (value >= min && value <= max) { return; }
        add(key, key + " is " + number_text(value) + "; it goes from " + number_text(min) + " to " + number_text(max));
    }

    std::vector<Problem> take() { return std::move(problems_); }

private:
    std::optional<std::size_t> axis_;
    std::string prefix_;
    std::vector<Problem> problems_;
};

}  // namespace lockstep
