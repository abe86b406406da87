// The places of motors as sums of shares of the axes' places: a matrix.
//
// A straight line stays straight, and a piece of constant acceleration stays one. Speeds and accelerations are mapped
// by the same matrix.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace lockstep {

class LinearMap {
public:
    LinearMap() = default;
    /// All factors are 0.
    LinearMap(std::size_t motors, std::size_t axes) : axes_(axes), factors_(motors * axes) {}
    static LinearMap identity(std::size_t axes);

    std::size_t motors() const { return axes_ == 0 ? 0 : factors_.size() / axes_; }
    std::size_t axes() const { return axes_; }
    double factor(std::size_t motor, std::size_t axis) const { return factors_[motor * axes_ + axis]; }
    double& factor(std::size_t motor, std::size_t axis) { return factors_[motor * axes_ + axis]; }
    std::span<const double> row(std::size_t motor) const { return std::span(factors_).subspan(motor * axes_, axes_); }

    /// Each axis is moved by one motor, which has its place and its number.
    bool is_identity() const;
    /// The axis that alone moves a motor; nullopt if several do, or none.
    std::optional<std::size_t> only_axis_of(std::size_t motor) const;

    /// The place of a motor.
    template <typename Places>
    double place(std::size_t motor, const Places& axes) const {
        double sum = 0;
        for (std::size_t i = 0; i < axes_; ++i) { sum += factor(motor, i) * static_cast<double>(axes[i]); }
        return sum;
    }

    /// This map after `first`, which maps axes to axes.
    LinearMap after(const LinearMap& first) const;
    /// The map from motors to axes that is nearest to the inverse: places of motors to which no place of the axes
    /// belongs give those from which the motors differ least, by the sum of squares. nullopt if different places of the
    /// axes have the same places of the motors.
    std::optional<LinearMap> inverse() const;

private:
    std::size_t axes_ = 0;
    std::vector<double> factors_;  // one row for each motor
};

}  // namespace lockstep
