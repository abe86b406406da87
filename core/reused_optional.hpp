// An optional value that keeps its allocated memory while it is absent.
#pragma once

#include <utility>

#include "core/check.hpp"

namespace lockstep {

template <typename T>
class ReusedOptional {
public:
    ReusedOptional() = default;
    ReusedOptional(const ReusedOptional& other) { *this = other; }
    ReusedOptional& operator=(const ReusedOptional& other) {
        if (this == &other) { return *this; }
        has_value_ = other.has_value_;
        if (has_value_) { value_ = other.value_; }
        return *this;
    }
    ReusedOptional(ReusedOptional&&) = default;
    ReusedOptional& operator=(ReusedOptional&&) = default;
    ~ReusedOptional() = default;

    /// Makes the value what `make(old)` returns. `old` is an earlier value, whose memory it may take.
    template <typename Make>
    T& renew(Make&& make) {
        has_value_ = true;
        return value_ = make(std::move(value_));
    }
    void reset() { has_value_ = false; }

    bool has_value() const { return has_value_; }
    explicit operator bool() const { return has_value_; }
    T& operator*() {
        check(has_value_, "a value that is used is there");
        return value_;
    }
    const T& operator*() const {
        check(has_value_, "a value that is used is there");
        return value_;
    }
    T* operator->() { return &**this; }
    const T* operator->() const { return &**this; }

private:
    T value_{};
    bool has_value_ = false;
};

}  // namespace lockstep
