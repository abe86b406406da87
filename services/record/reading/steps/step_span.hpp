// Consecutive steps of one axis, in 4 bytes each: ticks after a common origin.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>

#include "core/step/segment.hpp"

namespace lockstep::analysis {

/// Steps that another object keeps, like a std::span of them. Ticks rise strictly; directions are +1 or -1.
class StepSpan {
public:
    class Iterator {
    public:
        using value_type = StepEdge;
        using difference_type = std::ptrdiff_t;

        Iterator() = default;
        Iterator(const StepSpan* steps, std::ptrdiff_t at) : steps_(steps), at_(at) {}
        StepEdge operator*() const { return (*steps_)[static_cast<std::size_t>(at_)]; }
        Iterator& operator++() {
            ++at_;
            return *this;
        }
        Iterator operator++(int) { return {steps_, at_++}; }
        bool operator==(const Iterator& other) const { return at_ == other.at_; }

    private:
        const StepSpan* steps_ = nullptr;
        std::ptrdiff_t at_ = 0;
    };

    StepSpan() = default;
    /// `directions`: of each step; null if all have `direction`.
    StepSpan(Tick origin, std::span<const std::int32_t> ticks, std::int8_t direction, const std::int8_t* directions)
        : origin_(origin), ticks_(ticks), directions_(directions), direction_(direction) {}

    bool empty() const { return ticks_.empty(); }
    std::size_t size() const { return ticks_.size(); }
    Iterator begin() const { return {this, 0}; }
    Iterator end() const { return {this, std::ssize(ticks_)}; }
    Tick tick(std::size_t i) const { return origin_ + Ticks{ticks_[i]}; }
    std::int8_t direction(std::size_t i) const { return directions_ != nullptr ? directions_[i] : direction_; }
    StepEdge operator[](std::size_t i) const { return {tick(i), direction(i)}; }
    StepEdge front() const { return (*this)[0]; }
    StepEdge back() const { return (*this)[size() - 1]; }

    StepSpan first(std::size_t count) const { return {origin_, ticks_.first(count), direction_, directions_}; }
    StepSpan subspan(std::size_t from) const {
        return {origin_, ticks_.subspan(from), direction_, directions_ != nullptr ? directions_ + from : nullptr};
    }
    StepSpan subspan(std::size_t from, std::size_t count) const { return subspan(from).first(count); }

    /// The tick of a step is the origin plus its number here.
    Tick origin() const { return origin_; }
    const std::int32_t* ticks() const { return ticks_.data(); }
    /// Whether no step reverses, as far as is known without a look at each.
    bool is_one_way() const { return directions_ == nullptr; }
    /// The number of steps, from the first on, that go in its direction.
    std::size_t one_way() const {
        if (is_one_way()) { return size(); }
        const auto reverses = [&](std::int8_t direction) { return direction != directions_[0]; };
        return static_cast<std::size_t>(std::find_if(directions_, directions_ + size(), reverses) - directions_);
    }
    /// The number of steps before a tick.
    std::size_t before(Tick tick) const {
        if (empty() || this->tick(size() - 1) < tick) { return size(); }
        const Ticks reach = tick - origin_;
        return static_cast<std::size_t>(std::ranges::lower_bound(ticks_, reach.value) - ticks_.begin());
    }
    /// The change of the position by all of them. Costs no time per step if none reverses.
    std::int64_t change() const {
        return is_one_way() ? std::ssize(ticks_) * direction_
                            : std::accumulate(directions_, directions_ + size(), std::int64_t{0});
    }

private:
    Tick origin_;
    std::span<const std::int32_t> ticks_;
    const std::int8_t* directions_ = nullptr;
    std::int8_t direction_ = 0;
};

/// The number of steps from the first on that are equal, if those of `a` are `later` than those of `b`.
std::size_t equal_steps(const StepSpan& a, const StepSpan& b, Ticks later = {});

}  // namespace lockstep::analysis
