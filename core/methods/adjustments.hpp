// What a method changes of a move that it cannot express: refused or said, as the caller wants.
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

    /// Error where the move must be made exactly and cannot be.
    std::expected<void, StepError> allowed_by(Fit fit) const {
        if (fit == Fit::Nearest || text_.empty()) { return {}; }
        return std::unexpected(StepError{.why = StepError::Why::Inexact, .nearest = text_});
    }

private:
    std::string text_;
};

}  // namespace lockstep::methods
