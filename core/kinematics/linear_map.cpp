#include "core/kinematics/linear_map.hpp"

#include <algorithm>
#include <cmath>

#include "core/check.hpp"

namespace lockstep {
namespace {

constexpr double kSingular = 1e-9;  // a pivot below this share of the greatest factor

/// Solves `square` x = `right` for each column of `right`, by elimination with the greatest pivot. Both are destroyed.
/// Returns false if `square` is singular.
bool solve(LinearMap& square, LinearMap& right) {
    const std::size_t n = square.axes();
    double greatest = 0;
    for (std::size_t i = 0; i < n; ++i) {
        for (const double factor : square.row(i)) { greatest = std::max(greatest, std::abs(factor)); }
    }
    const auto swap_rows = [](LinearMap& map, std::size_t a, std::size_t b) {
        for (std::size_t i = 0; i < map.axes(); ++i) { std::swap(map.factor(a, i), map.factor(b, i)); }
    };
    const auto subtract = [](LinearMap& map, std::size_t from, std::size_t row, double share) {
        for (std::size_t i = 0; i < map.axes(); ++i) { map.factor(from, i) -= share * map.factor(row, i); }
    };
    for (std::size_t k = 0; k < n; ++k) {
        std::size_t pivot = k;
        for (std::size_t row = k + 1; row < n; ++row) {
            if (std::abs(square.factor(row, k)) > std::abs(square.factor(pivot, k))) { pivot = row; }
        }
        if (!(std::abs(square.factor(pivot, k)) > kSingular * greatest)) { return false; }
        swap_rows(square, k, pivot);
        swap_rows(right, k, pivot);
        for (std::size_t row = 0; row < n; ++row) {
            if (row == k) { continue; }
            const double share = square.factor(row, k) / square.factor(k, k);
            subtract(square, row, k, share);
            subtract(right, row, k, share);
        }
    }
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = 0; i < right.axes(); ++i) { right.factor(k, i) /= square.factor(k, k); }
    }
    return true;
}

}  // namespace

LinearMap LinearMap::identity(std::size_t axes) {
    LinearMap map(axes, axes);
    for (std::size_t i = 0; i < axes; ++i) { map.factor(i, i) = 1; }
    return map;
}

bool LinearMap::is_identity() const {
    if (motors() != axes_) { return false; }
    for (std::size_t m = 0; m < motors(); ++m) {
        for (std::size_t i = 0; i < axes_; ++i) {
            if (factor(m, i) != (m == i ? 1 : 0)) { return false; }
        }
    }
    return true;
}

std::optional<std::size_t> LinearMap::only_axis_of(std::size_t motor) const {
    std::optional<std::size_t> only;
    for (std::size_t i = 0; i < axes_; ++i) {
        if (factor(motor, i) == 0) { continue; }
        if (only) { return std::nullopt; }
        only = i;
    }
    return only;
}

LinearMap LinearMap::after(const LinearMap& first) const {
    check(first.motors() == axes_, "a map is applied to as many places as it has columns");
    LinearMap product(motors(), first.axes());
    for (std::size_t m = 0; m < motors(); ++m) {
        for (std::size_t i = 0; i < first.axes(); ++i) {
            for (std::size_t k = 0; k < axes_; ++k) { product.factor(m, i) += factor(m, k) * first.factor(k, i); }
        }
    }
    return product;
}

std::optional<LinearMap> LinearMap::inverse() const {
    if (axes_ == 0 || motors() < axes_) { return std::nullopt; }
    LinearMap square(axes_, axes_);
    LinearMap right(axes_, motors());
    const bool is_square = motors() == axes_;
    if (is_square) {
        square = *this;
        right = identity(axes_);
    } else {  // the normal equations: (M^T M) x = M^T
        for (std::size_t a = 0; a < axes_; ++a) {
            for (std::size_t m = 0; m < motors(); ++m) {
                right.factor(a, m) = factor(m, a);
                for (std::size_t b = 0; b < axes_; ++b) { square.factor(a, b) += factor(m, a) * factor(m, b); }
            }
        }
    }
    if (!solve(square, right)) { return std::nullopt; }
    return right;
}

}  // namespace lockstep
