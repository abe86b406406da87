// Collects the errors of a scenario file, each with the place of its key in the text.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "clients/scenario/model/scenario.hpp"
#include "core/number_text.hpp"
#include "services/documents/text/text_source.hpp"

namespace lockstep::scenario {

/// "X, Y, Z"
inline std::string listed(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

class Problems {
public:
    explicit Problems(const TextSource& source) : source_(source) {}

    void add(const std::string& path, const std::string& message) {
        const auto place = source_.place_of(*Asked::descriptor(), path);
        errors_.push_back({place.line, place.column, message});
    }

    void require(bool holds, const std::string& path, const std::string& message) {
        if (!holds) { add(path, message); }
    }

    /// `block` and `key` make the path.
    void require_range(const std::string& block, const std::string& key, double value, double min, double max) {
        require(value >= min && value <= max, block + "." + key,
                fmt::format("{} is {}; it must be from {} to {}", key, number_text(value), number_text(min),
                            number_text(max)));
    }

    void require_one_of(const std::string& path, const std::string& name, const std::vector<std::string>& names,
                        const std::string& what) {
        require(std::ranges::find(names, name) != names.end(), path,
                fmt::format("there is no {} '{}'; there are: {}", what, name, listed(names)));
    }

    /// Returns the errors in the order of the text.
    Diagnostics take() {
        std::ranges::stable_sort(errors_, {}, [](const Diagnostic& d) { return std::tuple(d.line, d.column); });
        return std::move(errors_);
    }

private:
    const TextSource& source_;
    Diagnostics errors_;
};

/// "step" and 2: "step[2]"
inline std::string nth(const std::string& key, int index) { return key + "[" + std::to_string(index) + "]"; }

}  // namespace lockstep::scenario
