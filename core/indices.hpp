// Numbers and sets of axes, of motors and of a path's rows: never the same thing, even if the numbers are.
#pragma once

#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

namespace lockstep {

inline constexpr std::size_t kMaxAxes = 64;  // of axes, of motors, and of rows

/// The place of something in its order. It can be used as a number but is made from one only explicitly: what wants the
/// number of a motor takes neither that of an axis nor a plain one.
template <typename Of>
class Index {
public:
    constexpr Index() = default;
    constexpr explicit Index(std::size_t number) : number_(number) {}
    template <typename Other>
    explicit Index(Index<Other>) = delete;

    constexpr operator std::size_t() const { return number_; }  // NOLINT(google-explicit-constructor)
    constexpr std::size_t number() const { return number_; }
    constexpr Index& operator++() {
        ++number_;
        return *this;
    }

private:
    std::size_t number_ = 0;
};

/// An axis in the order of the configuration.
using AxisIndex = Index<struct OfAxes>;
/// A motor, or a board, in the order of motors_of (core/kinematics/motors.hpp).
using MotorIndex = Index<struct OfMotors>;
/// A row of a path (core/path/path_setup.hpp).
using RowIndex = Index<struct OfRows>;

/// The first `count` indices in order.
template <typename AnIndex>
class IndexRange {
public:
    class Iterator {
    public:
        constexpr explicit Iterator(AnIndex at) : at_(at) {}
        constexpr AnIndex operator*() const { return at_; }
        constexpr Iterator& operator++() {
            ++at_;
            return *this;
        }
        constexpr bool operator!=(const Iterator& other) const { return at_.number() != other.at_.number(); }

    private:
        AnIndex at_;
    };

    constexpr explicit IndexRange(std::size_t count) : count_(count) {}
    constexpr Iterator begin() const { return Iterator{AnIndex{0}}; }
    constexpr Iterator end() const { return Iterator{AnIndex{count_}}; }

private:
    std::size_t count_;
};

constexpr IndexRange<AxisIndex> axis_indices(std::size_t count) { return IndexRange<AxisIndex>(count); }
constexpr IndexRange<MotorIndex> motor_indices(std::size_t count) { return IndexRange<MotorIndex>(count); }
constexpr IndexRange<RowIndex> row_indices(std::size_t count) { return IndexRange<RowIndex>(count); }

/// Indices below kMaxAxes. A loop over it visits them in ascending order.
template <typename AnIndex>
class IndexSet {
public:
    class Iterator {
    public:
        constexpr explicit Iterator(std::uint64_t left) : left_(left) {}
        constexpr AnIndex operator*() const { return AnIndex{static_cast<std::size_t>(std::countr_zero(left_))}; }
        constexpr Iterator& operator++() {
            left_ &= left_ - 1;
            return *this;
        }
        constexpr bool operator!=(const Iterator& other) const { return left_ != other.left_; }

    private:
        std::uint64_t left_;
    };

    constexpr IndexSet() = default;
    constexpr IndexSet(std::initializer_list<AnIndex> indices) {
        for (const AnIndex index : indices) { insert(index); }
    }
    /// Bit i stands for index i.
    static constexpr IndexSet of_bits(std::uint64_t bits) {
        IndexSet set;
        set.bits_ = bits;
        return set;
    }
    static constexpr IndexSet first(std::size_t count) {
        return of_bits(count == 0 ? 0 : ~std::uint64_t{0} >> (kMaxAxes - count));
    }

    constexpr std::uint64_t bits() const { return bits_; }
    constexpr bool empty() const { return bits_ == 0; }
    constexpr std::size_t size() const { return static_cast<std::size_t>(std::popcount(bits_)); }
    constexpr bool contains(AnIndex index) const { return (bits_ >> index.number() & 1) != 0; }
    constexpr bool contains(IndexSet other) const { return (other.bits_ & ~bits_) == 0; }
    constexpr void insert(AnIndex index) { bits_ |= std::uint64_t{1} << index.number(); }
    constexpr void erase(AnIndex index) { bits_ &= ~(std::uint64_t{1} << index.number()); }

    /// The set must not be empty.
    constexpr AnIndex front() const { return *begin(); }
    constexpr Iterator begin() const { return Iterator{bits_}; }
    constexpr Iterator end() const { return Iterator{0}; }

    constexpr IndexSet operator|(IndexSet other) const { return of_bits(bits_ | other.bits_); }
    constexpr IndexSet operator&(IndexSet other) const { return of_bits(bits_ & other.bits_); }
    constexpr IndexSet operator-(IndexSet other) const { return of_bits(bits_ & ~other.bits_); }
    constexpr IndexSet& operator|=(IndexSet other) { return *this = *this | other; }
    constexpr bool operator==(const IndexSet&) const = default;

private:
    std::uint64_t bits_ = 0;
};

using AxisSet = IndexSet<AxisIndex>;
using MotorSet = IndexSet<MotorIndex>;
using RowSet = IndexSet<RowIndex>;

}  // namespace lockstep
