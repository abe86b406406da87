// The changes that a method makes to a move that it cannot express. The caller refuses or reports them.
#pragma once

#include <string>
#include <string_view>

#include "core/methods/method.hpp"

namespace lockstep::methods {

class Adjustments {
public:
    /// "cannot start at a speed: starts and ends at rest"
    void add(std::string_view lack, std::string_view instead) {
        if (!text_.empty()) { text_ += "; "; }
        text_.append(lack).append(": ").append(instead);
    }
    const std::string& text() const { return text_; }

    /// Returns an error if the move must be made exactly and there are changes.
    std::expected<void, StepError> allowed_by(Fit fit) const {
        if (fit == Fit::Nearest || text_.empty()) { return {}; }
        return std::unexpected(StepError{.why = StepError::Why::Inexact, .nearest = text_});
    }

private:
    std::string text_;
};

}  // namespace lockstep::methods
